// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Resizing of pictures that must share a texture array.
#include <pellucid/core/image.hpp>
#include <pellucid/scene/mipmap.hpp>
#include <algorithm>
#include <cmath>

namespace pellucid {

/// `[h, w, 4]` resampled to `size` by bilinear interpolation between texel centres (edges are clamped); sRGB colour is
/// interpolated in linear light.  The picture itself where it has that size already.
[[nodiscard]] inline Image8 resized(const Image8& image, Extent2D size, bool srgb) {
    if (image.width == size.width && image.height == size.height) return image;
    Image8 out(size.width, size.height, 4);
    auto place = [](std::uint32_t i, std::uint32_t to, std::uint32_t from, std::uint32_t& low, std::uint32_t& high) {
        const double x = std::clamp((i + 0.5) * from / to - 0.5, 0.0, from - 1.0);
        low = static_cast<std::uint32_t>(x);
        high = std::min(low + 1, from - 1);
        return x - low;
    };
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            std::uint32_t x0, x1, y0, y1;
            const double fx = place(x, size.width, image.width, x0, x1);
            const double fy = place(y, size.height, image.height, y0, y1);
            for (std::uint32_t c = 0; c < 4; ++c) {
                auto value = [&](std::uint32_t u, std::uint32_t v) {
                    const std::uint8_t code = image.texel(u, v)[c];
                    return srgb && c < 3 ? static_cast<double>(linear_from_srgb(code)) : code / 255.0;
                };
                const double top = value(x0, y0) + (value(x1, y0) - value(x0, y0)) * fx;
                const double bottom = value(x0, y1) + (value(x1, y1) - value(x0, y1)) * fx;
                const double v = top + (bottom - top) * fy;
                out.texel(x, y)[c] = srgb && c < 3 ? srgb_from_linear(v) : static_cast<std::uint8_t>(std::lround(v * 255));
            }
        }
    return out;
}

}  // namespace pellucid
