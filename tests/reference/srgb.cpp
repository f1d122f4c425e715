// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/srgb.hpp>
#include "support/catch.hpp"

using namespace pellucid::reference;

TEMPLATE_TEST_CASE("all 256 sRGB codes survive the round trip", "[cpu]", float, double) {
    TestType last = -1;
    for (int code = 0; code < 256; ++code) {
        const auto linear = linear_from_srgb8<TestType>(static_cast<std::uint8_t>(code));
        REQUIRE(srgb8_from_linear(linear) == code);
        REQUIRE(linear > last);
        last = linear;
    }
}

TEST_CASE("the sRGB curves have the standard's values", "[cpu]") {
    CHECK(srgb_from_linear(0.0) == 0.0);
    CHECK(srgb_from_linear(1.0) == Approx(1.0).margin(1e-15));
    CHECK(linear_from_srgb(1.0) == Approx(1.0).margin(1e-15));
    CHECK(srgb_from_linear(0.001) == Approx(0.01292).margin(1e-15));
    CHECK(srgb_from_linear(0.18) == Approx(0.461356129500442).margin(1e-12));
    CHECK(linear_from_srgb(0.5) == Approx(0.214041140482233).margin(1e-12));
    // The two branches meet to 3e-8.
    CHECK(std::abs(1.055 * std::pow(0.0031308, 1 / 2.4) - 0.055 - 12.92 * 0.0031308) < 4e-8);
    // A power of 2.2 is 8 codes away where it is dark.
    CHECK(std::abs(255 * std::pow(0.002, 1 / 2.2) - 255 * srgb_from_linear(0.002)) > 8.0);
}

TEST_CASE("8-bit encoding limits what is outside and takes NaN as 0", "[cpu]") {
    CHECK(srgb8_from_linear(-1.0) == 0);
    CHECK(srgb8_from_linear(std::numeric_limits<double>::quiet_NaN()) == 0);
    CHECK(srgb8_from_linear(2.0) == 255);
    CHECK(srgb8_from_linear(std::numeric_limits<double>::infinity()) == 255);
    CHECK(unorm8(0.5 / 255) == 1);
    CHECK(unorm8(0.499 / 255) == 0);
    CHECK(unorm8(-0.0) == 0);
}
