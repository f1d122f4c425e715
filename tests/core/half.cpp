// SPDX-License-Identifier: MIT
#include <pellucid/core/half.hpp>
#include <cmath>
#include <limits>
#include "support/catch.hpp"

using namespace pellucid;

TEST_CASE("every finite half survives the round trip", "[cpu]") {
    for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const float value = half_to_float(half);
        if (std::isnan(value)) {
            CHECK(std::isnan(half_to_float(half_toward_zero(value))));
            continue;
        }
        REQUIRE(half_toward_zero(value) == half);
    }
}

TEST_CASE("conversion to half rounds toward zero", "[cpu]") {
    const float one_up = half_to_float(0x3C01);  // 1 + 2^-10
    CHECK(half_toward_zero(std::nextafter(one_up, 0.0f)) == 0x3C00);
    CHECK(half_toward_zero(-std::nextafter(one_up, 0.0f)) == 0xBC00);
    CHECK(half_toward_zero(65535.0f) == 0x7BFF);
    CHECK(half_toward_zero(1e30f) == 0x7BFF);
    CHECK(half_toward_zero(std::numeric_limits<float>::infinity()) == 0x7C00);
    CHECK(half_toward_zero(0x1p-24f) == 1);
    CHECK(half_toward_zero(0x1.8p-24f) == 1);
    CHECK(half_toward_zero(0x1.fp-25f) == 0);
    CHECK(half_toward_zero(-0.0f) == 0x8000);
}
