// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A picture → the levels of one layer of a texture array.
#include <algorithm>
#include <cmath>
#include <pellucid/core/image.hpp>
#include <pellucid/scene/mipmap.hpp>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1 {

/// `image` `[h, w, 4]` with another size: texel centres are mapped linearly and the four nearest texels mixed, colours
/// in linear light.  Sizes that are equal give the same bytes.  Precondition: 4 channels, neither size is empty.
[[nodiscard]] inline Image8 resized(const Image8& image, Extent2D size, bool srgb) {
    if (image.width == size.width && image.height == size.height) return image;
    struct Tap {
        std::uint32_t low, high;
        double share;  ///< of `high`
    };
    auto tap = [](std::uint32_t i, std::uint32_t from, std::uint32_t to) {
        const double at = std::clamp((i + 0.5) * from / to - 0.5, 0.0, from - 1.0);
        const auto low = static_cast<std::uint32_t>(at);
        return Tap{low, std::min(low + 1, from - 1), at - low};
    };
    Image8 out(size.width, size.height, 4);
    for (std::uint32_t y = 0; y < size.height; ++y) {
        const Tap v = tap(y, image.height, size.height);
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const Tap u = tap(x, image.width, size.width);
            for (std::uint32_t c = 0; c < 4; ++c) {
                const bool curve = srgb && c < 3;
                auto value = [&](std::uint32_t tx, std::uint32_t ty) {
                    const std::uint8_t code = image.texel(tx, ty)[c];
                    return curve ? static_cast<double>(linear_from_srgb(code)) : code / 255.0;
                };
                const double top = std::lerp(value(u.low, v.low), value(u.high, v.low), u.share);
                const double bottom = std::lerp(value(u.low, v.high), value(u.high, v.high), u.share);
                const double mixed = std::lerp(top, bottom, v.share);
                out.texel(x, y)[c] = curve ? srgb_from_linear(mixed) : static_cast<std::uint8_t>(mixed * 255.0 + 0.5);
            }
        }
    }
    return out;
}

/// Level 0 at `size`, and the levels below it where the sampler wants them.
[[nodiscard]] inline std::vector<Image8> texture_levels(const Image8& image, Extent2D size, bool srgb, bool mipmapped) {
    Image8 level = resized(image, size, srgb);
    if (mipmapped) return make_mipmaps(level, srgb ? MipContent::color_with_alpha : MipContent::data);
    std::vector<Image8> levels;
    levels.push_back(std::move(level));
    return levels;
}

}  // namespace pellucid::inline v0_1
