// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Keys and pointers as an X server reports them, sent to a window by the test.
#include <cstdint>

namespace pellucid::test {

/// Sends events to one window; its window library takes them in with the next poll.
class WindowHands {
public:
    /// `display`: a `Display*`.
    WindowHands(void* display, std::uintptr_t window) : display_(display), window_(window) {}

    void key(unsigned keysym, bool down);  ///< an X keysym; of printable ASCII its code
    void tap(unsigned keysym) { key(keysym, true), key(keysym, false); }
    void button(unsigned number, bool down);  ///< 1 left, 3 right, 4 and 5 the wheel
    void move(int x, int y);                  ///< [pixel] to this place in the window

private:
    void* display_;
    std::uintptr_t window_;
    int x_ = 0, y_ = 0;
    unsigned long time_ = 1000;  ///< [ms] rising, as window libraries expect
};

}  // namespace pellucid::test
