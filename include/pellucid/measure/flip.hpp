// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// FLIP, the difference that a person perceives who alternates between two pictures: 0 where none is seen, 1 the
/// largest.  Andersson et al. 2020 (see flip_color.hpp); the mean is what its authors recommend as the one number.
///
/// The algorithm.  Colour: the picture in YyCxCz is filtered by the eye's contrast sensitivity, limited to [0,1] in
/// linear RGB, taken to CIELAB with the Hunt effect; ΔE_c is the redistributed HyAB distance.  Features: on luminance
/// (Yy + 16)/116 in [0,1], the lengths of the gradients of edges and of points; ΔE_f = (max(|Δedge|, |Δpoint|) / √2)^½.
/// Error: ΔE = ΔE_c^(1 − ΔE_f).  Filters see the nearest pixel of the border beyond it, so any size has an answer.
/// LDR-FLIP is symmetric in its pictures.
///
/// Beyond the paper, for pictures of renderers: a pixel that is not finite on either side has the error 1, is counted,
/// and is black in both pictures for its neighbours; negative light is 0.
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/flip_filters.hpp>
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1::measure {

/// How a person looks at the pictures, and which pixels count.
struct FlipOptions {
    double pixels_per_degree = flip::default_pixels_per_degree;  ///< in [1, 1000]; `flip::pixels_per_degree` makes one
    /// Null, or `[h, w, 1]`: pixels of value 255 are pooled.  The others are still seen by their neighbours.
    const Image8* mask = nullptr;
};

/// All numbers are of the pooled pixels; NaN where there are none.
struct FlipError {
    ImageF map;                    ///< [h, w, 1], errors in [0,1] of all pixels
    std::uint64_t pixels = 0;      ///< pooled
    std::uint64_t masked_out = 0;  ///< pixels that the mask left out
    std::uint64_t nonfinite = 0;   ///< pooled pixels that are not finite on either side
    double mean = 0, min = 0, max = 0;
    /// Of errors weighted by themselves: the smallest e such that the errors up to e add up to more than ¼, ½, ¾ of
    /// their sum (0 where all are 0): where the bulk of the error is, whatever the size of the untouched background.
    double weighted_lower_quartile = 0, weighted_median = 0, weighted_upper_quartile = 0;
};

/// LDR-FLIP of two pictures `[h, w, c]` of linear light as displayed at exposure 1 (values above 1 are 1), c = 1, 3, 4.
/// Errors: invalid_argument where shapes do not match or `pixels_per_degree` is out of range.
[[nodiscard]] Result<FlipError> ldr_flip(const ImageF& test, const ImageF& reference, const FlipOptions& options = {});

/// One JSON object with the members' names but the map; numbers that are not finite become null.
[[nodiscard]] std::string to_json(const FlipError& error);

namespace flip {

/// The metric's core: ΔE of two pictures `[h, w, 3]` of finite linear RGB in [0,1]; `[h, w, 1]`.
/// Precondition: equal sizes, and 1 <= ppd <= 1000.
[[nodiscard]] Image<double> error_map(const Image<double>& test, const Image<double>& reference, double ppd);

}  // namespace flip
}  // namespace pellucid::inline v0_1::measure

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/measure/flip-inl.hpp>
#endif
