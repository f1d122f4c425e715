// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Differences of coverage, counted apart from differences of shading.  Two renderers that disagree about which layers
/// cover a pixel (a tie of the fill rule, an edge through a pixel centre) are wrong there by a whole surface; one such
/// pixel hides how well the others are shaded.  So pixels are *stable*, covered alike, or *unstable*; each kind has its
/// own error and its own count, and neither is ever left out.
#include <pellucid/measure/image_error.hpp>
#include <algorithm>

namespace pellucid::inline v0_1::measure {

/// Layers over each pixel, `[h, w, 1]`.
using LayerCounts = Image<std::uint32_t>;

/// How the numbers of layers of two pictures differ.
struct LayerDifference {
    std::uint64_t pixels = 0;
    std::uint64_t different = 0;        ///< with another number of layers; the sum of the next two
    std::uint64_t more = 0, fewer = 0;  ///< layers in the test picture than in the reference
    std::uint64_t only_test = 0;        ///< covered in the test picture and not in the reference
    std::uint64_t only_reference = 0;   ///< the other way round
    std::uint32_t max = 0;              ///< largest difference of a pixel [layers]
    Image8 stable;                      ///< [h, w, 1]: 255 where the numbers are equal, else 0
};

/// Where two pictures have different numbers of layers.
/// Errors: invalid_argument where they are not `[h, w, 1]` of one size.
[[nodiscard]] inline Result<LayerDifference> layer_difference(const LayerCounts& test, const LayerCounts& reference);

/// The errors of stable and of unstable pixels, apart.
struct CoverageError {
    std::uint64_t stable_pixels = 0, unstable_pixels = 0;
    /// Errors as image_error.hpp has them, of the stable and of the unstable pixels alone.
    ImageError stable, unstable;
};

/// The errors of `test` against `reference`, both `[h, w, c]`, with `stable` `[h, w, 1]`: 255 = stable, others are not.
/// Errors: those of `image_error`.
[[nodiscard]] inline Result<CoverageError> coverage_error(const ImageF& test, const ImageF& reference,
                                                          const Image8& stable,
                                                          ErrorScale scale = ErrorScale::absolute);

/// One JSON object with the members' names but the mask.
[[nodiscard]] inline std::string to_json(const LayerDifference& difference);
[[nodiscard]] inline std::string to_json(const CoverageError& error);

// ---------------------------------------------------------------------------------------------------- bodies

Result<LayerDifference> layer_difference(const LayerCounts& test, const LayerCounts& reference) {
    if (test.width != reference.width || test.height != reference.height || test.channels != 1 ||
        reference.channels != 1)
        return Error{Errc::invalid_argument, "layer difference: the test counts are " + detail::shape(test) +
                                                 " and the reference counts are " + detail::shape(reference) +
                                                 ", but both must have the same [h, w, 1]"};
    LayerDifference result{.pixels = test.data.size(), .stable = Image8(test.width, test.height, 1)};
    for (std::size_t i = 0; i < test.data.size(); ++i) {
        const std::uint32_t a = test.data[i], b = reference.data[i];
        result.stable.data[i] = a == b ? 255 : 0;
        result.different += a != b;
        result.more += a > b;
        result.fewer += a < b;
        result.only_test += a > 0 && b == 0;
        result.only_reference += a == 0 && b > 0;
        result.max = std::max(result.max, a > b ? a - b : b - a);
    }
    return result;
}

Result<CoverageError> coverage_error(const ImageF& test, const ImageF& reference, const Image8& stable,
                                     ErrorScale scale) {
    CoverageError result;
    PELLUCID_TRY(result.stable, image_error(test, reference, {.scale = scale, .mask = &stable}));
    Image8 others(stable.width, stable.height, 1);
    for (std::size_t i = 0; i < others.data.size(); ++i) others.data[i] = stable.data[i] == 255 ? 0 : 255;
    PELLUCID_TRY(result.unstable, image_error(test, reference, {.scale = scale, .mask = &others}));
    result.stable_pixels = result.stable.pixels;
    result.unstable_pixels = result.unstable.pixels;
    return result;
}

std::string to_json(const LayerDifference& difference) {
    detail::JsonObject object;
    object.add("pixels", difference.pixels).add("different", difference.different);
    object.add("more", difference.more).add("fewer", difference.fewer);
    object.add("only_test", difference.only_test).add("only_reference", difference.only_reference);
    object.add("max", std::uint64_t{difference.max});
    return object.close();
}

/// One JSON object with the members' names.
std::string to_json(const CoverageError& error) {
    detail::JsonObject object;
    object.add("stable_pixels", error.stable_pixels).add("unstable_pixels", error.unstable_pixels);
    object.raw("stable", to_json(error.stable)).raw("unstable", to_json(error.unstable));
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
