// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of mipmap.hpp.
#include <pellucid/scene/mipmap.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pellucid::inline v0_1 {
namespace detail {

inline const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < 256; ++i) {
            const double s = static_cast<double>(i) / 255.0;
            values[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

/// The texels that one texel of a smaller level covers along one axis, and the share of each.
struct MipTap {
    std::uint32_t first = 0, count = 0;
    double weight[3] = {};
};
inline std::vector<MipTap> mip_taps(std::uint32_t from, std::uint32_t to) {
    std::vector<MipTap> taps(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        if (from == to) {
            taps[i] = {i, 1, {1.0}};  // a side that is 1 already
        } else if (from == 2 * to) {
            taps[i] = {2 * i, 2, {0.5, 0.5}};
        } else {
            const double n = from;
            taps[i] = {2 * i, 3, {(to - i) / n, to / n, (i + 1) / n}};
        }
    }
    return taps;
}

/// One level of straight colour from the one above; `fetch(x, y, out[4])` reads a texel of that.
template <class Fetch>
ImageF mip_step(Extent2D from, bool weighted, const Fetch& fetch) {
    ImageF target(std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), 4);
    const std::vector<MipTap> columns = mip_taps(from.width, target.width), rows = mip_taps(from.height, target.height);
    for (std::uint32_t y = 0; y < target.height; ++y)
        for (std::uint32_t x = 0; x < target.width; ++x) {
            double even[4] = {}, by_alpha[3] = {};
            for (std::uint32_t j = 0; j < rows[y].count; ++j)
                for (std::uint32_t i = 0; i < columns[x].count; ++i) {
                    float texel[4];
                    fetch(columns[x].first + i, rows[y].first + j, texel);
                    const double weight = rows[y].weight[j] * columns[x].weight[i];
                    for (int c = 0; c < 4; ++c) even[c] += weight * texel[c];
                    for (int c = 0; c < 3; ++c) by_alpha[c] += weight * texel[3] * texel[c];
                }
            float* out = target.texel(x, y);
            const bool divide = weighted && even[3] > 0;
            for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(divide ? by_alpha[c] / even[3] : even[c]);
            out[3] = static_cast<float>(even[3]);
        }
    return target;
}

}  // namespace detail

PELLUCID_INLINE float linear_from_srgb(std::uint8_t code) {
    return detail::srgb_table()[code];
}

PELLUCID_INLINE std::uint8_t srgb_from_linear(double linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const double s = linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(s * 255.0 + 0.5);
}

PELLUCID_INLINE std::uint32_t mip_count(Extent2D size) {
    return size.width == 0 || size.height == 0
               ? 0
               : static_cast<std::uint32_t>(std::bit_width(std::max(size.width, size.height)));
}

PELLUCID_INLINE std::vector<Image8> make_mipmaps(const Image8& image, MipContent content) {
    assert(image.channels == 4 && image.width > 0 && image.height > 0);
    const bool srgb = content != MipContent::data, weighted = content == MipContent::color_with_alpha;
    const std::uint32_t levels = mip_count({image.width, image.height});
    std::vector<Image8> chain;
    chain.reserve(levels);
    chain.push_back(image);
    ImageF current;
    for (std::uint32_t level = 1; level < levels; ++level) {
        if (level == 1) {
            const auto& table = detail::srgb_table();
            current = detail::mip_step(
                {image.width, image.height}, weighted, [&](std::uint32_t x, std::uint32_t y, float* texel) {
                    const std::uint8_t* codes = image.texel(x, y);
                    for (int c = 0; c < 4; ++c)
                        texel[c] = srgb && c < 3 ? table[codes[c]] : static_cast<float>(codes[c]) / 255.0f;
                });
        } else {
            current = detail::mip_step(
                {current.width, current.height}, weighted,
                [&](std::uint32_t x, std::uint32_t y, float* texel) { std::copy_n(current.texel(x, y), 4, texel); });
        }
        Image8& rounded = chain.emplace_back(current.width, current.height, 4);
        for (std::size_t i = 0; i < rounded.data.size(); ++i) {
            const float value = current.data[i];
            rounded.data[i] = srgb && i % 4 != 3
                                  ? srgb_from_linear(value)
                                  : static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
        }
    }
    return chain;
}

}  // namespace pellucid::inline v0_1
