// SPDX-License-Identifier: MIT
#include <pellucid/measure/coverage.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
LayerCounts counts(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> data) {
    LayerCounts result(width, height, 1);
    REQUIRE(result.data.size() == data.size());
    result.data = std::move(data);
    return result;
}
}  // namespace

TEST_CASE("layers are counted in both directions", "[cpu]") {
    const LayerDifference difference =
        *layer_difference(counts(3, 2, {0, 1, 2, 5, 0, 7}), counts(3, 2, {0, 1, 3, 0, 9, 6}));
    CHECK(difference.pixels == 6);
    CHECK(difference.different == 4);
    CHECK(difference.more == 2);
    CHECK(difference.fewer == 2);
    CHECK(difference.only_test == 1);
    CHECK(difference.only_reference == 1);
    CHECK(difference.max == 9);
    CHECK(difference.stable.data == std::vector<std::uint8_t>{255, 255, 0, 0, 0, 0});
    CHECK(difference.stable.channels == 1);
    CHECK((*layer_difference(counts(1, 1, {0}), counts(1, 1, {0xFFFFFFFFu}))).max == 0xFFFFFFFFu);
    CHECK((*layer_difference(counts(1, 1, {0xFFFFFFFFu}), counts(1, 1, {0}))).max == 0xFFFFFFFFu);
    const LayerDifference equal = *layer_difference(counts(2, 1, {3, 0}), counts(2, 1, {3, 0}));
    CHECK(equal.different == 0);
    CHECK(equal.max == 0);
    CHECK((*layer_difference(LayerCounts(0, 0, 1), LayerCounts(0, 0, 1))).pixels == 0);
}

TEST_CASE("stable and unstable pixels have their own errors, and together they are all", "[cpu]") {
    const ImageF reference = grey(2, 2, 0.5f);
    ImageF test = reference;
    test.texel(0, 0)[0] = 0.625f;  // stable: 0.125
    test.texel(1, 1)[2] = 4.5f;    // unstable: 4
    Image8 stable(2, 2, 1);
    stable.data = {255, 255, 254, 0};
    const CoverageError error = *coverage_error(test, reference, stable);
    CHECK(error.stable_pixels == 2);
    CHECK(error.unstable_pixels == 2);
    CHECK(error.stable.max == 0.125);
    CHECK(error.stable.rmse == Approx(0.125 / std::sqrt(6.0)).epsilon(1e-14));
    CHECK(error.unstable.max == 4);
    CHECK(error.unstable.worst.x == 1);
    CHECK(error.unstable.worst.y == 1);
    CHECK(error.stable.scale == ErrorScale::absolute);
    const ImageError all = *image_error(test, reference);
    CHECK(error.stable.values + error.unstable.values == all.values);
    CHECK(error.stable.different_values + error.unstable.different_values == all.different_values);
    const CoverageError scaled = *coverage_error(grey(1, 1, 6), grey(1, 1, 4), Image8(1, 1, 1), ErrorScale::scaled);
    CHECK(scaled.unstable.max == 0.5);
}

TEST_CASE("masks that leave nothing on a side say so", "[cpu]") {
    const ImageF reference = grey(2, 1, 0.5f);
    ImageF test = grey(2, 1, 1);
    test.data[0] = not_a_number;
    Image8 mask(2, 1, 1);
    const CoverageError none = *coverage_error(test, reference, mask);
    CHECK(none.stable_pixels == 0);
    CHECK(none.stable.values == 0);
    CHECK_FALSE(none.stable.within(1e30));
    CHECK(none.unstable_pixels == 2);
    CHECK(none.unstable.nonfinite == 1);
    CHECK(none.unstable.max == 0.5);
    mask.data = {255, 255};
    const CoverageError every = *coverage_error(test, reference, mask);
    CHECK(every.unstable_pixels == 0);
    CHECK(every.stable.nonfinite == 1);
}

TEST_CASE("coverage names shapes that do not match", "[cpu]") {
    const auto message = [](const auto& result) {
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        return result.error().message;
    };
    CHECK(message(layer_difference(LayerCounts(2, 3, 1), LayerCounts(3, 2, 1))).find("[3, 2, 1]") != std::string::npos);
    CHECK(message(layer_difference(LayerCounts(2, 2, 2), LayerCounts(2, 2, 1))).find("[2, 2, 2]") != std::string::npos);
    CHECK(message(layer_difference(LayerCounts(2, 2, 1), LayerCounts(2, 2, 0))).find("[2, 2, 0]") != std::string::npos);
    CHECK(message(coverage_error(ImageF(2, 2, 3), ImageF(2, 2, 3), Image8(2, 1, 1))).find("mask") != std::string::npos);
    CHECK(message(coverage_error(ImageF(2, 2, 3), ImageF(2, 2, 4), Image8(2, 2, 1))).find("[2, 2, 4]") !=
          std::string::npos);
}

TEST_CASE("coverage as JSON", "[cpu]") {
    CHECK(to_json(*layer_difference(counts(2, 1, {1, 0}), counts(2, 1, {0, 0}))) ==
          "{\"pixels\": 2, \"different\": 1, \"more\": 1, \"fewer\": 0, \"only_test\": 1, \"only_reference\": 0, "
          "\"max\": 1}");
    const std::string json = to_json(*coverage_error(grey(1, 1, 1), grey(1, 1, 0), Image8(1, 1, 1)));
    CHECK(json.find("{\"stable_pixels\": 0, \"unstable_pixels\": 1, \"stable\": {\"scale\": \"absolute\"") == 0);
    CHECK(json.find("\"unstable\": {\"scale\": \"absolute\", \"pixels\": 1") != std::string::npos);
}
