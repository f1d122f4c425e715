// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Pictures on the CPU.  Row 0 is the top row, everywhere in this library.
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pellucid::inline v0_1 {

/// The size of a picture [texel].
struct Extent2D {
    std::uint32_t width = 0;   ///< [texel]
    std::uint32_t height = 0;  ///< [texel]
    friend constexpr bool operator==(Extent2D, Extent2D) = default;
};

/// `[height, width, channels]` values of `T`, tightly packed, row 0 at the top.
template <class T>
struct Image {
    std::uint32_t width = 0;     ///< [texel]
    std::uint32_t height = 0;    ///< [texel]
    std::uint32_t channels = 0;  ///< values a texel
    std::vector<T> data;         ///< width · height · channels values

    Image() = default;
    Image(std::uint32_t w, std::uint32_t h, std::uint32_t c)
        : width(w), height(h), channels(c), data(std::size_t{w} * h * c) {}

    [[nodiscard]] T* texel(std::uint32_t x, std::uint32_t y) {
        return data.data() + (std::size_t{y} * width + x) * channels;
    }
    [[nodiscard]] const T* texel(std::uint32_t x, std::uint32_t y) const {
        return data.data() + (std::size_t{y} * width + x) * channels;
    }
    [[nodiscard]] bool empty() const noexcept { return data.empty(); }
};

/// 8 bits a channel.
using Image8 = Image<std::uint8_t>;
/// Single precision.
using ImageF = Image<float>;

}  // namespace pellucid::inline v0_1
