// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Every metric of this folder in one call, and in one report: what a table or a chart of techniques is made of.
#include <pellucid/core/config.hpp>
#include <pellucid/core/flags.hpp>
#include <pellucid/measure/coverage.hpp>
#include <pellucid/measure/hdr_flip.hpp>
#include <pellucid/measure/psnr.hpp>
#include <pellucid/measure/ssim.hpp>
#include <optional>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {
namespace measure {

/// Which metrics `quality` computes: flags.
enum class QualityMetrics : std::uint32_t {
    errors = 1,  ///< image_error.hpp, absolute and scaled
    tone_mapped_psnr = 2,
    ssim = 4,
    ldr_flip = 8,
    hdr_flip = 16,  ///< the one that takes seconds
    coverage = 32,  ///< where a mask or layer counts are given
    all = 63
};

/// Which metrics, over which pixels.
struct QualityOptions {
    QualityMetrics metrics = QualityMetrics::all;
    /// Null, or `[h, w, 1]`: 255 = stable.  Every metric but the coverage is of these pixels; the coverage has the
    /// errors of the others.
    const Image8* mask = nullptr;
    /// Null both, or numbers of layers `[h, w, 1]`: a pixel with different numbers is unstable too, for the coverage
    /// only.
    const LayerCounts* test_layers = nullptr;
    const LayerCounts* reference_layers = nullptr;
    ErrorScale scale = ErrorScale::scaled;                       ///< of the coverage's errors
    double pixels_per_degree = flip::default_pixels_per_degree;  ///< of FLIP, in [1, 1000]
};

/// A metric that was not asked for, or that these pictures do not have, is absent; `notes` says why for the latter.
struct QualityReport {
    std::uint32_t width = 0, height = 0, channels = 0;
    std::optional<ImageError> absolute, scaled;
    std::optional<ToneMappedPsnr> tone_mapped_psnr;
    std::optional<SsimResult> ssim;
    std::optional<FlipError> ldr_flip;
    std::optional<HdrFlipError> hdr_flip;
    std::optional<LayerDifference> layers;  ///< where layer counts were given
    std::optional<CoverageError> coverage;
    std::vector<std::string> notes;  ///< one sentence for each metric that had to be left out
};

/// Compares `test` with `reference`, both `[h, w, c]` of linear light, c = 1, 3 or 4.  Pictures that are too small for
/// SSIM are no error: it is left out with a note.  Values that are not finite are treated and counted by each metric as
/// it documents.
/// Errors: invalid_argument where shapes do not match, one of the layer counts is missing, or an option is out of
/// range.
[[nodiscard]] Result<QualityReport> quality(const ImageF& test, const ImageF& reference,
                                            const QualityOptions& options = {});

/// One JSON object with the members' names but the maps; absent metrics and numbers that are not finite are null.
[[nodiscard]] std::string to_json(const QualityReport& report);

/// One paragraph of English for a log or a commit message, without a line break.
[[nodiscard]] std::string to_text(const QualityReport& report);

}  // namespace measure

template <>
inline constexpr bool enable_flags<measure::QualityMetrics> = true;

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/measure/quality-inl.hpp>
#endif
