// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Error pictures as colour, and always with the scale that gives the colours their meaning.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <pellucid/core/image.hpp>

namespace pellucid::inline v0_1::measure {

/// How errors become colours.
enum class HeatScale : std::uint8_t { linear, logarithmic };

/// The range of a heat map's colours, and its mask.
struct HeatMapOptions {
    HeatScale scale = HeatScale::logarithmic;
    double low = 0;   ///< error of the darkest colour; logarithmic: > 0, or 0 for high/10⁴
    double high = 0;  ///< error of the brightest colour; 0: the largest finite error of the picture
};

/// `rgb` is [h, w, 3], sRGB.  Error e has the palette's place t = (e − low)/(high − low), or, on the logarithmic scale,
/// t = log(e/low)/log(high/low); t is limited to [0,1].
/// Black: e is exactly 0 (or negative).  Magenta: e is not a number or infinite.
struct HeatMap {
    Image8 rgb;
    HeatScale scale = HeatScale::logarithmic;
    double low = 0, high = 0;  ///< what was used; high = 0 where no pixel has an error
};

/// An sRGB colour.
using Rgb8 = std::array<std::uint8_t, 3>;

/// The colour at `t` in [0,1] (limited; NaN gives the darkest): black through violet, red and orange to white.
/// The 17 knots were computed in Oklab: lightness 0.12 + 0.86 t, so that brighter is always more; hue 275° + 190° t;
/// chroma 0.19 sin(π t)^0.7, less where sRGB ends.  Between knots the codes are interpolated linearly.
[[nodiscard]] inline Rgb8 heat_color(double t) noexcept;

/// Colours `error`, which is [h, w, 1] with values >= 0 or NaN (`error_picture` makes one).
[[nodiscard]] inline HeatMap heat_map(const ImageF& error, const HeatMapOptions& options = {});

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {
inline constexpr Rgb8 heat_knots[17] = {
    {6, 6, 6},      {15, 10, 41},   {36, 11, 66},    {60, 10, 85},    {88, 9, 98},    {117, 8, 104},
    {146, 12, 103}, {173, 25, 97},  {198, 44, 88},   {219, 67, 76},   {234, 94, 64},  {244, 123, 60},
    {248, 152, 71}, {248, 180, 99}, {246, 207, 138}, {244, 230, 185}, {248, 248, 248}};
}

Rgb8 heat_color(double t) noexcept {
    const double position = t > 0 ? std::min(t, 1.0) * 16 : 0.0;
    const auto knot = static_cast<std::size_t>(std::min(position, 15.0));
    const double part = position - static_cast<double>(knot);
    Rgb8 color;
    for (std::size_t c = 0; c < 3; ++c) {
        const double below = detail::heat_knots[knot][c], above = detail::heat_knots[knot + 1][c];
        color[c] = static_cast<std::uint8_t>(below + (above - below) * part + 0.5);
    }
    return color;
}

HeatMap heat_map(const ImageF& error, const HeatMapOptions& options) {
    HeatMap map{Image8(error.width, error.height, 3), options.scale, options.low, options.high};
    if (!(map.high > 0)) {
        map.high = 0;
        for (const float e : error.data)
            if (std::isfinite(e)) map.high = std::max(map.high, static_cast<double>(e));
    }
    if (map.scale == HeatScale::logarithmic && !(map.low > 0)) map.low = map.high * 1e-4;
    for (std::size_t i = 0; i < error.data.size(); ++i) {
        const double e = error.data[i];
        Rgb8 color{0, 0, 0};
        if (!std::isfinite(e)) {
            color = {255, 0, 255};
        } else if (e > 0) {
            const bool flat = !(map.high > map.low);  // one value only: it is the brightest
            const double t = map.scale == HeatScale::linear ? (e - map.low) / (map.high - map.low)
                                                            : std::log(e / map.low) / std::log(map.high / map.low);
            color = heat_color(flat ? (e >= map.high ? 1.0 : 0.0) : t);
        }
        std::copy(color.begin(), color.end(), map.rgb.data.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return map;
}

}  // namespace pellucid::inline v0_1::measure
