// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// SSIM, structural similarity: 1 for equal pictures, around 0 for unrelated ones, below 0 where structure is inverted.
/// Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to structural similarity", IEEE
/// Trans. Image Processing 13(4), 2004.  Equations 13 to 17 there: within each window of 11 × 11 pixels, weighted by a
/// Gaussian of σ = 1.5 pixels and sum 1, with means μ, variances σ² and covariance σ_xy,
///   SSIM = (2 μx μy + C1)(2 σ_xy + C2) / ((μx² + μy² + C1)(σx² + σy² + C2)),  C1 = (0.01 L)², C2 = (0.03 L)²,
/// of the luma (L = 1) of pictures shown by `fixed_tone_map`.
///
/// Borders: only windows that lie in the picture count, as in the authors' ssim_index.m; nothing is mirrored or padded.
/// The pictures are not scaled down first (the authors suggest that for pictures seen from farther away).
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1::measure {

inline constexpr std::uint32_t ssim_window = 11;  ///< side of a window [pixel]

/// SSIM of two pictures: the map and its mean.
struct SsimResult {
    ImageF map;                 ///< [h, w, 1]: SSIM in [−1,1] of the window around a pixel; NaN: no full window there
    std::uint64_t windows = 0;  ///< that count: full, with a centre that the mask lets through
    std::uint64_t nonfinite = 0;  ///< of these, the ones that hold a pixel that is not finite on either side: SSIM −1
    double mean = 0;              ///< mean SSIM over the windows, in [−1,1]; NaN where there are none
};

/// Both pictures `[h, w, c]` of linear light, h and w >= 11, c = 1, 3 or 4; `mask` null or `[h, w, 1]`: windows around
/// pixels of value 255 count (they still see their whole window).
/// Errors: invalid_argument where the shapes do not match or the pictures are smaller than a window.
[[nodiscard]] Result<SsimResult> ssim(const ImageF& test, const ImageF& reference, const Image8* mask = nullptr);

/// One JSON object with the members' names but the map; a mean of nothing becomes null.
[[nodiscard]] std::string to_json(const SsimResult& result);

}  // namespace pellucid::inline v0_1::measure

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/measure/ssim-inl.hpp>
#endif
