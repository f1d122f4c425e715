// SPDX-License-Identifier: MIT
#include "support/window_events.hpp"
#include <X11/Xlib.h>

namespace pellucid::test {
namespace {

template <class E>
void send(void* connection, std::uintptr_t to, long mask, XEvent event, E XEvent::*kind) {
    auto* display = static_cast<Display*>(connection);
    const auto window = static_cast<Window>(to);
    (event.*kind).display = display;
    (event.*kind).window = window;
    (event.*kind).root = DefaultRootWindow(display);
    (event.*kind).same_screen = True;
    XSendEvent(display, window, False, mask, &event);
    XSync(display, False);
}

}  // namespace

void WindowHands::key(unsigned keysym, bool down) {
    XEvent event{};
    event.xkey.type = down ? KeyPress : KeyRelease;
    event.xkey.time = time_ += 20;
    event.xkey.x = x_;
    event.xkey.y = y_;
    event.xkey.keycode = XKeysymToKeycode(static_cast<Display*>(display_), keysym);
    send(display_, window_, down ? KeyPressMask : KeyReleaseMask, event, &XEvent::xkey);
}

void WindowHands::button(unsigned number, bool down) {
    XEvent event{};
    event.xbutton.type = down ? ButtonPress : ButtonRelease;
    event.xbutton.time = time_ += 20;
    event.xbutton.x = x_;
    event.xbutton.y = y_;
    event.xbutton.button = number;
    send(display_, window_, down ? ButtonPressMask : ButtonReleaseMask, event, &XEvent::xbutton);
}

void WindowHands::move(int x, int y) {
    XWarpPointer(static_cast<Display*>(display_), None, static_cast<Window>(window_), 0, 0, 0, 0, x_ = x, y_ = y);
    XSync(static_cast<Display*>(display_), False);
}

}  // namespace pellucid::test
