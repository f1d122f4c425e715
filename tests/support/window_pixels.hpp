// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the X server shows in a window: the last link of the chain, and no API's own word for it.
#include <pellucid/core/image.hpp>
#include <cstdint>

namespace pellucid::test {

/// `[h, w, 3]` codes of the window's inside, row 0 at the top.  `display`: a `Display*`.  The window must lie inside
/// the screen; empty where X refuses.
[[nodiscard]] Image8 window_pixels(void* display, std::uintptr_t window, Extent2D size);

}  // namespace pellucid::test
