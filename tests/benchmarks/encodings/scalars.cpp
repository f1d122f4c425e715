// SPDX-License-Identifier: MIT
#include "encodings/scalars.hpp"
#include <limits>
#include <pellucid/reference/gbuffer.hpp>
#include "encodings/errors.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::bench;

TEST_CASE("a number through bits is off by half a step at most, as the library rounds", "[cpu]") {
    EncodingRandom random(6);
    for (const std::uint32_t bits : {1u, 8u, 10u, 12u, 16u, 24u}) {
        const double half = 0.5 / (std::exp2(bits) - 1);
        double worst = 0;
        for (int i = 0; i < 10000; ++i) {
            const double v = random.uniform();
            worst = std::max(worst, std::abs(through_unorm(v, bits) - v));
        }
        CHECK(worst <= half * (1 + 1e-9));
        CHECK(worst >= 0.98 * half);
        CHECK(through_unorm(0, bits) == 0);
        CHECK(through_unorm(1, bits) == 1);
        CHECK(through_unorm(-1, bits) == 0);
        CHECK(through_unorm(2, bits) == 1);
        CHECK(through_unorm(std::numeric_limits<double>::quiet_NaN(), bits) == 0);
    }
    for (int i = 0; i < 10000; ++i) {
        const double v = random.uniform();
        REQUIRE(through_unorm(v, 16) == (reference::pack_material(v, 0.0, 0) & 0xFFFFu) / 65535.0);
        REQUIRE(through_unorm(v, 8) == reference::unorm8(v) / 255.0);
    }
}

TEST_CASE("the peak's error near a roughness lies between its closed forms", "[cpu]") {
    CHECK(peak_error(0.1, 0.1) == 0);
    CHECK(peak_error(0.2, 0.1) == Approx(15));
    CHECK(peak_error(0.1, 0.2) == Approx(15.0 / 16));
    CHECK(std::isinf(peak_error(0.001, 0)));
    // A midpoint m between two codes lies within half a step h of r, and (m/(m − h))⁴ is between these.
    const struct {
        std::uint32_t bits;
        double at_01, at_0045, digit;  // another program's (1 + h/r)⁴ − 1 and its last digit, as printed [%]
    } known[] = {{8, 8.1, 18.6, 0.1}, {10, 2.0, 4.4, 0.1}, {12, 0.5, 1.1, 0.1}, {16, 0.03, 0.07, 0.01}};
    for (const auto& k : known)
        for (const double r : {0.02, 0.045, 0.1, 0.2}) {
            CAPTURE(k.bits, r);
            const double h = 0.5 / (std::exp2(k.bits) - 1);
            const double low = std::pow(1 + h / r, 4) - 1, high = std::pow((r - h) / (r - 2 * h), 4) - 1;
            const double worst = worst_peak_error(r, k.bits);
            CHECK(worst >= 0.998 * low);
            CHECK(worst <= high * (1 + 1e-9));
            const double printed = r == 0.1 ? k.at_01 : r == 0.045 ? k.at_0045 : 0;
            if (printed > 0) CHECK(std::abs(100 * low - printed) <= 0.5 * k.digit);
        }
}

TEST_CASE("sRGB bytes keep all 256 codes; gamma 2.2 and linear bytes do not", "[cpu]") {
    const auto changed = [](ColorForm form) {
        int count = 0;
        for (int code = 0; code < 256; ++code) {
            const double value = reference::linear_from_srgb8(static_cast<std::uint8_t>(code));
            count += reference::srgb8_from_linear(decode_color(form, encode_color(form, value))) != code;
        }
        return count;
    };
    CHECK(changed(ColorForm::srgb) == 0);
    CHECK(changed(ColorForm::gamma) > 0);
    CHECK(changed(ColorForm::linear) > changed(ColorForm::gamma));
    CHECK(changed(ColorForm::gamma_srgb) > changed(ColorForm::linear));
}

TEST_CASE("every colour code comes back from its own value, and what is outside is limited", "[cpu]") {
    for (const ColorForm form : {ColorForm::srgb, ColorForm::linear, ColorForm::gamma}) {
        for (int code = 0; code < 256; ++code)
            REQUIRE(encode_color(form, decode_color(form, static_cast<std::uint8_t>(code))) == code);
        CHECK(encode_color(form, -1) == 0);
        CHECK(encode_color(form, 2) == 255);
        CHECK(encode_color(form, std::numeric_limits<double>::quiet_NaN()) == 0);
    }
}
