// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One fixed way of showing linear light, so that HDR pictures are compared as a person sees them on an SDR display,
/// and so that a number of today and a number of next year speak of the same thing: exposure 1, limited to [0,1],
/// encoded as sRGB (IEC 61966-2-1), in double, without rounding to codes.  It is part of the definition of a metric and
/// therefore not a setting; the renderer's own tone curves are unrelated.
///
/// What the metrics of displayed pictures (PSNR, SSIM, FLIP) share: a picture is `[h, w, c]` of linear light, c = 1
/// (grey), 3 (RGB) or 4 (RGB and an alpha that is not light and not looked at).  A pixel with a colour channel that is
/// NaN or infinite is *not finite*: it is never left out, it is counted and has the largest error there is.
#include <algorithm>
#include <cmath>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/image_error.hpp>
#include <string>

namespace pellucid::inline v0_1::measure {

/// Linear light → display signal in [0,1]: `12.92 x` up to 0.0031308, then `1.055 x^(1/2.4) − 0.055` (IEC 61966-2-1).
/// Below 0 and NaN: 0; above 1: 1.
[[nodiscard]] inline double fixed_tone_map(double linear) noexcept {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Channels of light among `channels`: 1 of 1, 3 of 3 or 4.
[[nodiscard]] constexpr std::uint32_t color_channels(std::uint32_t channels) noexcept {
    return channels == 1 ? 1 : 3;
}

/// Whether all channels of light of a pixel are finite.
[[nodiscard]] inline bool finite_color(const float* pixel, std::uint32_t channels) noexcept {
    return std::all_of(pixel, pixel + color_channels(channels), [](float v) { return std::isfinite(v); });
}

/// Luma in [0,1] of a pixel shown by `fixed_tone_map`: 0.2126 R' + 0.7152 G' + 0.0722 B' (ITU-R BT.709), or the signal
/// itself where the picture is grey.
[[nodiscard]] inline double fixed_luma(const float* pixel, std::uint32_t channels) noexcept {
    if (channels == 1) return fixed_tone_map(pixel[0]);
    // Equal channels give exactly their own value: the weights' sum is rounded otherwise.
    if (pixel[0] == pixel[1] && pixel[1] == pixel[2]) return fixed_tone_map(pixel[0]);
    return 0.2126 * fixed_tone_map(pixel[0]) + 0.7152 * fixed_tone_map(pixel[1]) + 0.0722 * fixed_tone_map(pixel[2]);
}

namespace detail {

/// What every metric of displayed pictures asks of its input; `what` names the metric.
[[nodiscard]] inline Result<void> check_colors(const ImageF& test, const ImageF& reference, const Image8* mask,
                                               const char* what) {
    PELLUCID_CHECK(check_shapes(test, reference, mask, what));
    if (test.channels == 2)
        return Error{Errc::invalid_argument,
                     std::string(what) + ": the pictures are " + shape(test) +
                         ", but must have 1 channel (grey), 3 (RGB) or 4 (RGB and alpha) to be shown"};
    return {};
}

/// Whether the mask lets a pixel through.
[[nodiscard]] inline bool compared(const Image8* mask, std::uint32_t x, std::uint32_t y) {
    return !mask || *mask->texel(x, y) == 255;
}

}  // namespace detail
}  // namespace pellucid::inline v0_1::measure
