// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Small pictures for the tests of metrics.
#include <cmath>
#include <limits>
#include <pellucid/core/image.hpp>
#include <random>

namespace pictures {

using pellucid::Image8;
using pellucid::ImageF;

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// One colour everywhere.
inline ImageF uniform(std::uint32_t width, std::uint32_t height, float r, float g, float b) {
    ImageF image(width, height, 3);
    for (std::size_t i = 0; i < image.data.size(); i += 3) {
        image.data[i] = r;
        image.data[i + 1] = g;
        image.data[i + 2] = b;
    }
    return image;
}
inline ImageF grey(std::uint32_t width, std::uint32_t height, float value) {
    return uniform(width, height, value, value, value);
}

/// Independent values in [low, high), the same in every run and on every standard library.
inline ImageF noise(std::uint32_t width, std::uint32_t height, std::uint32_t channels, unsigned seed, double low,
                    double high) {
    ImageF image(width, height, channels);
    std::mt19937 generator(seed);
    for (float& value : image.data)
        value = static_cast<float>(low + (high - low) * (static_cast<double>(generator()) / 4294967296.0));
    return image;
}

/// The linear light that `fixed_tone_map` shows as `signal` in [0,1].
inline float shown_as(double signal) {
    return static_cast<float>(signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4));
}

/// A picture of one channel of which `signal(x, y)` in [0,1] is what is shown.
template <class F>
ImageF shown(std::uint32_t width, std::uint32_t height, const F& signal) {
    ImageF image(width, height, 1);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) *image.texel(x, y) = shown_as(signal(x, y));
    return image;
}

}  // namespace pictures
