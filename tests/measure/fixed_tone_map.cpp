// SPDX-License-Identifier: MIT
#include <pellucid/measure/fixed_tone_map.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid::measure;
using namespace pictures;

TEST_CASE("the fixed map limits first, then encodes", "[cpu]") {
    CHECK(fixed_tone_map(not_a_number) == 0);
    CHECK(fixed_tone_map(-infinity) == 0);
    CHECK(fixed_tone_map(-1e-30) == 0);
    CHECK(fixed_tone_map(0) == 0);
    CHECK(fixed_tone_map(1) == 1);
    CHECK(fixed_tone_map(1e4) == 1);
    CHECK(fixed_tone_map(infinity) == 1);
    CHECK(fixed_tone_map(std::numeric_limits<float>::denorm_min()) > 0);
    CHECK(fixed_tone_map(0.001) == Approx(0.01292).epsilon(1e-15));
    CHECK(fixed_tone_map(0.18) == Approx(0.46135612950044164).epsilon(1e-14));  // 1.055 · 0.18^(1/2.4) − 0.055
    CHECK(fixed_tone_map(0.5) == Approx(0.7353569830524495).epsilon(1e-14));
}

TEST_CASE("the fixed map rises, and its pieces meet within the step that the standard's constants leave", "[cpu]") {
    double last = 0;
    for (int i = 1; i <= 4096; ++i) {
        const double now = fixed_tone_map(i / 4096.0);
        REQUIRE(now > last);
        last = now;
    }
    CHECK(std::abs(fixed_tone_map(0.0031308) - fixed_tone_map(std::nextafter(0.0031308, 1))) < 3e-8);
}

TEST_CASE("luma weighs the encoded channels", "[cpu]") {
    const float colors[3] = {0.18f, 0, 1};
    const double expected = 0.2126 * fixed_tone_map(0.18f) + 0.0722;
    CHECK(fixed_luma(colors, 3) == Approx(expected).epsilon(1e-14));
    CHECK(fixed_luma(colors, 4) == fixed_luma(colors, 3));
    CHECK(fixed_luma(colors, 1) == fixed_tone_map(0.18f));
    const float same[4] = {0.3f, 0.3f, 0.3f, 9};
    CHECK(fixed_luma(same, 4) == fixed_tone_map(0.3f));
}

TEST_CASE("alpha is no light", "[cpu]") {
    const float pixel[4] = {1, 2, 3, not_a_number};
    CHECK(finite_color(pixel, 4));
    CHECK(finite_color(pixel, 3));
    const float bad[3] = {not_a_number, 2, infinity};
    CHECK_FALSE(finite_color(bad, 3));
    CHECK_FALSE(finite_color(bad, 1));
    CHECK(finite_color(bad + 1, 1));
    CHECK(color_channels(1) == 1);
    CHECK(color_channels(3) == 3);
    CHECK(color_channels(4) == 3);
}
