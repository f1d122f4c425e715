// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// HDR-FLIP: the largest LDR-FLIP that any of a range of exposures shows.  Andersson, Nilsson, Shirley and
/// Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021 short papers.
///
/// An exposure of c stops shows 2^c times the light through Narkowicz's fit of ACES, y(x) = (k0 x² + k1 x) /
/// (k3 x² + k4 x + k5), limited to [0,1].  With x_max the light that y takes to t = 0.85 and Y the luminance of the
/// reference, exposures start at log2(x_max / Y_max), where only the brightest is not blown out, and stop at
/// log2(x_max / Y_median); there are max(2, ⌈stop − start⌉), evenly spaced.  Not symmetric: exposures are the
/// reference's.
///
/// Defined beyond the paper: light above 65536 is 65536; the median of a picture that is black for more than its half
/// is that of its lit pixels (other implementations take 2^-23 there, which amplifies what no one sees);
/// luminances below 2^-23 count as 2^-23; a reference that is all black is shown at exposure 0.  Pixels that are not
/// finite: as in flip.hpp.
#include <pellucid/measure/flip.hpp>
#include <limits>

namespace pellucid::inline v0_1::measure {

/// How a person looks at the pictures, and at which exposures.
struct HdrFlipOptions {
    double pixels_per_degree = flip::default_pixels_per_degree;  ///< in [1, 1000]
    const Image8* mask = nullptr;                                ///< as in `FlipOptions`; exposures ignore it
    /// [stops]; NaN: from the reference.  In [−100, 100], and start <= stop.
    double start_exposure = std::numeric_limits<double>::quiet_NaN();
    double stop_exposure = std::numeric_limits<double>::quiet_NaN();
    std::uint32_t exposures = 0;  ///< 2 … 256; 0: max(2, ⌈stop − start⌉)
};

/// The largest errors over all exposures.
struct HdrFlipError {
    FlipError error;  ///< of the largest errors
    ImageF exposure;  ///< [h, w, 1]: the exposure [stops] that shows the largest error first, `start_exposure` if none
    double start_exposure = 0, stop_exposure = 0;  ///< [stops]
    std::uint32_t exposures = 0;
};

/// HDR-FLIP of two pictures `[h, w, c]` of linear light, c = 1, 3 or 4.
/// Errors: invalid_argument where shapes do not match or an option is out of range.
[[nodiscard]] Result<HdrFlipError> hdr_flip(const ImageF& test, const ImageF& reference,
                                            const HdrFlipOptions& options = {});

/// One JSON object with the members' names but the maps, those of `error` included.
[[nodiscard]] std::string to_json(const HdrFlipError& error);

namespace flip {

/// The curve that HDR-FLIP shows pictures with, in [0,1] for x >= 0: Narkowicz 2016 without its pre-exposure of 0.6.
[[nodiscard]] double aces(double x) noexcept;
/// x_max: the light that `aces` takes to 0.85; 2.11887.
[[nodiscard]] double brightest_shown() noexcept;

/// First and last exposure of a reference [stops].
struct ExposureRange {
    double start = 0, stop = 0;
};
/// `reference` is [h, w, 3] of finite linear RGB >= 0.
[[nodiscard]] ExposureRange exposure_range(const Image<double>& reference);
/// max(2, ⌈stop − start⌉).
[[nodiscard]] std::uint32_t exposure_count(const ExposureRange& range) noexcept;

}  // namespace flip
}  // namespace pellucid::inline v0_1::measure

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/measure/hdr_flip-inl.hpp>
#endif
