// SPDX-License-Identifier: MIT
#include "support/window_pixels.hpp"
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace pellucid::test {

Image8 window_pixels(void* connection, std::uintptr_t window, Extent2D size) {
    auto* display = static_cast<Display*>(connection);
    XSync(display, False);
    XImage* shown = XGetImage(display, static_cast<Window>(window), 0, 0, size.width, size.height, AllPlanes, ZPixmap);
    if (!shown) return {};
    Image8 out(size.width, size.height, 3);
    const auto channel = [&](unsigned long pixel, unsigned long mask) {
        while (mask && !(mask & 1u)) mask >>= 1u, pixel >>= 1u;
        return static_cast<std::uint8_t>(pixel & mask);
    };
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const unsigned long pixel = XGetPixel(shown, static_cast<int>(x), static_cast<int>(y));
            std::uint8_t* texel = &out.data[3 * (std::size_t{y} * size.width + x)];
            texel[0] = channel(pixel, shown->red_mask);
            texel[1] = channel(pixel, shown->green_mask);
            texel[2] = channel(pixel, shown->blue_mask);
        }
    XDestroyImage(shown);
    return out;
}

}  // namespace pellucid::test
