// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// PSNR of linear-light pictures as displayed.  (PSNR of 8-bit pictures is in image_error.hpp.)
#include <pellucid/measure/fixed_tone_map.hpp>

namespace pellucid::inline v0_1::measure {

/// Of the display signals s in [0,1] that `fixed_tone_map` makes of the channels of light:
///   mse = Σ (s_test − s_reference)² / n;  psnr = 10 log10(1 / mse) [dB]
/// n counts the values of the pixels that the mask lets through.  A value that is not finite on either side has the
/// error 1.
struct ToneMappedPsnr {
    std::uint64_t pixels = 0;      ///< compared
    std::uint64_t masked_out = 0;  ///< pixels that the mask left out
    std::uint64_t nonfinite = 0;   ///< compared values that are not finite on either side
    double mse = 0;                ///< in [0,1]; NaN where no pixel was compared
    double psnr = 0;               ///< [dB] ≥ 0; infinite for equal pictures; NaN where no pixel was compared
};

/// Both pictures `[h, w, c]`, c = 1, 3 or 4; `mask` null or `[h, w, 1]` (255: compared).
/// Errors: invalid_argument where the shapes do not match.
[[nodiscard]] inline Result<ToneMappedPsnr> tone_mapped_psnr(const ImageF& test, const ImageF& reference,
                                                             const Image8* mask = nullptr);

/// One JSON object with the members' names; numbers that are not finite become null.
[[nodiscard]] inline std::string to_json(const ToneMappedPsnr& result);

// ---------------------------------------------------------------------------------------------------- bodies

Result<ToneMappedPsnr> tone_mapped_psnr(const ImageF& test, const ImageF& reference, const Image8* mask) {
    PELLUCID_CHECK(detail::check_colors(test, reference, mask, "tone-mapped PSNR"));
    ToneMappedPsnr result;
    const std::uint32_t colors = color_channels(test.channels);
    double squares = 0;
    for (std::uint32_t y = 0; y < test.height; ++y)
        for (std::uint32_t x = 0; x < test.width; ++x) {
            if (!detail::compared(mask, x, y)) {
                ++result.masked_out;
                continue;
            }
            ++result.pixels;
            for (std::uint32_t c = 0; c < colors; ++c) {
                const float v = test.texel(x, y)[c], r = reference.texel(x, y)[c];
                const bool finite = std::isfinite(v) && std::isfinite(r);
                result.nonfinite += !finite;
                const double error = finite ? fixed_tone_map(v) - fixed_tone_map(r) : 1.0;
                squares += error * error;
            }
        }
    result.mse = squares / static_cast<double>(result.pixels * colors);  // 0/0 where nothing was compared
    result.psnr = 10 * std::log10(1 / result.mse);
    return result;
}

std::string to_json(const ToneMappedPsnr& result) {
    detail::JsonObject object;
    object.add("pixels", result.pixels).add("masked_out", result.masked_out).add("nonfinite", result.nonfinite);
    object.add("mse", result.mse).add("psnr", result.psnr);
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
