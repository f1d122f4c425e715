// SPDX-License-Identifier: MIT
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <pellucid/reference/tonemap.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;
using pellucid::test::Random;

namespace {
constexpr ToneMap all_operators[] = {ToneMap::none, ToneMap::reinhard, ToneMap::neutral, ToneMap::aces, ToneMap::agx};

/// Where the middle channel lies between the least and the largest: the hue, up to which channel is which.
double middle(glm::dvec3 c) {
    const double low = std::min({c.x, c.y, c.z}), high = std::max({c.x, c.y, c.z});
    return (c.x + c.y + c.z - 2 * low - high) / (high - low);
}
}  // namespace

TEST_CASE("the neutral operator and its inverse meet to 1e-6", "[cpu]") {
    Random random(6);
    double worst = 0, worst_mapped = 0;
    for (int i = 0; i < 200000; ++i) {
        const double scale = std::exp(random.uniform(std::log(1e-6), std::log(1e3)));
        const glm::dvec3 color = glm::dvec3(random.uniform(), random.uniform(), random.uniform()) * scale;
        const glm::dvec3 mapped = tone_map_neutral(color);
        const glm::dvec3 back = inverse_tone_map_neutral(mapped);
        worst = std::max(worst, glm::length(back - color) / glm::length(color));
        worst_mapped = std::max(worst_mapped, glm::length(tone_map_neutral(back) - mapped));
    }
    CHECK(worst < 1e-6);
    CHECK(worst_mapped < 1e-9);
    CHECK(inverse_tone_map_neutral(glm::dvec3(0.0)) == glm::dvec3(0.0));
}

TEST_CASE("the neutral operator keeps base colours and hue", "[cpu]") {
    // Above 0.08 and below 0.8 a grey loses exactly the 0.04 that F0 adds to it.
    for (const double grey : {0.08, 0.3, 0.5, 0.79})
        CHECK(tone_map_neutral(glm::dvec3(grey)).y == Approx(grey - 0.04).epsilon(1e-13));
    CHECK(tone_map_neutral(glm::dvec3(0.04)).x == Approx(6.25 * 0.0016).epsilon(1e-12));
    // C¹ where compression starts.
    const double h = 1e-6, start = 0.8;
    const auto at = [](double v) { return tone_map_neutral(glm::dvec3(v)).x; };
    CHECK((at(start + h) - at(start)) / h == Approx((at(start) - at(start - h)) / h).epsilon(1e-4));
    Random random(8);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 color =
            glm::dvec3(random.uniform(), random.uniform(), random.uniform()) * random.uniform(0, 30);
        const glm::dvec3 mapped = tone_map_neutral(color);
        REQUIRE(middle(mapped) == Approx(middle(color)).margin(1e-7));
    }
    const glm::dvec3 red = tone_map(ToneMap::neutral, 0.0, glm::dvec3(1e4, 0, 0));
    CHECK(red.x > 0.999);
    CHECK(red.y == red.z);
    CHECK(red.y < red.x);
}

TEMPLATE_TEST_CASE("every operator takes every input and stays in [0,1]", "[cpu]", float, double) {
    using Vector = glm::vec<3, TestType>;
    constexpr TestType nan = std::numeric_limits<TestType>::quiet_NaN();
    constexpr TestType infinity = std::numeric_limits<TestType>::infinity();
    const TestType values[] = {0,
                               TestType(-0.0),
                               TestType(-1e-6),
                               -1,
                               TestType(1e-30),
                               TestType(0.04),
                               TestType(0.5),
                               1,
                               TestType(0.76),
                               TestType(0.8),
                               10,
                               10000,
                               65504,
                               TestType(1e30),
                               infinity,
                               -infinity,
                               nan};
    for (const ToneMap operation : all_operators)
        for (const TestType ev : {TestType(-32), TestType(-1), TestType(0), TestType(6), TestType(32)})
            for (const TestType r : values)
                for (const TestType g : values)
                    for (const TestType b : values) {
                        const Vector mapped = tone_map(operation, ev, Vector(r, g, b));
                        for (int c = 0; c < 3; ++c)
                            if (!(mapped[c] >= 0 && mapped[c] <= 1))
                                FAIL("operator " << int(operation) << " of " << r << ", " << g << ", " << b << " at EV "
                                                 << ev << " gives " << mapped[c]);
                    }
    for (const ToneMap operation : all_operators) {
        CHECK(tone_map(operation, TestType(0), Vector(nan)) == tone_map(operation, TestType(0), Vector(TestType(0))));
        CHECK(tone_map(operation, TestType(0), Vector(TestType(-5))) ==
              tone_map(operation, TestType(0), Vector(TestType(0))));
        CHECK(tone_map(operation, TestType(0), Vector(infinity)) ==
              tone_map(operation, TestType(0), Vector(TestType(65504))));
    }
}

TEST_CASE("a grey ramp stays grey and monotone, in value and in exposure", "[cpu]") {
    for (const ToneMap operation : all_operators) {
        double last = -1;
        for (int i = 0; i <= 20000; ++i) {
            const glm::dvec3 mapped = tone_map(operation, 0.0, glm::dvec3(std::exp2(-20 + 36.0 * i / 20000)));
            REQUIRE(mapped.x >= last);
            REQUIRE(std::abs(mapped.x - mapped.y) <
                    1e-3);  // the rows of AgX's published matrices sum to 1 only to 1.4e-4
            REQUIRE(std::abs(mapped.x - mapped.z) <
                    1e-3);  // the rows of AgX's published matrices sum to 1 only to 1.4e-4
            last = mapped.x;
            if (i % 100 == 0) {
                double exposed = -1;
                for (int ev = -16; ev <= 16; ++ev) {
                    const double x = tone_map(operation, double(ev), glm::dvec3(0.001 * i)).x;
                    REQUIRE(x >= exposed);
                    exposed = x;
                }
            }
        }
    }
}

TEST_CASE("the operators have their closed-form values", "[cpu]") {
    CHECK(tone_map(ToneMap::none, 0.0, glm::dvec3(0.25, 2, 0.5)) == glm::dvec3(0.25, 1, 0.5));
    CHECK(tone_map(ToneMap::none, -1.0, glm::dvec3(0.25, 2, 0.5)) == glm::dvec3(0.125, 1, 0.25));
    CHECK(tone_map(ToneMap::reinhard, 0.0, glm::dvec3(1, 3, 0)) == glm::dvec3(0.5, 0.75, 0));
    CHECK(tone_map(ToneMap::reinhard, 2.0, glm::dvec3(0.25)).x == 0.5);
    CHECK(tone_map_aces(glm::dvec3(1.0)).x == Approx(2.54 / 3.16).epsilon(1e-14));
    CHECK(tone_map(ToneMap::aces, 0.0, glm::dvec3(100.0)).x == 1.0);
    CHECK(tone_map_aces(glm::dvec3(0.0)) == glm::dvec3(0.0));
    // Peak 2 after the offset: p' = 1 − 0.0576/1.48, no saturation to lose on grey.
    CHECK(tone_map_neutral(glm::dvec3(2.04)).x == Approx(1 - 0.0576 / 1.48).epsilon(1e-13));
    // AgX puts black at 0, white just below 1, and the middle of its 16.5 stops at the middle of the sigmoid's domain.
    CHECK(tone_map(ToneMap::agx, 0.0, glm::dvec3(0.0)).x == 0.0);
    CHECK(tone_map(ToneMap::agx, 0.0, glm::dvec3(65504.0)).x == Approx(std::pow(0.99848, 2.2)).epsilon(2e-4));
    const double half = 15.5 / 64 - 40.14 / 32 + 31.96 / 16 - 6.868 / 8 + 0.4298 / 4 + 0.1191 / 2 - 0.00232;
    CHECK(tone_map_agx(glm::dvec3(std::exp2(0.5 * (4.026069 - 12.47393)))).x ==
          Approx(std::pow(half, 2.2)).epsilon(2e-4));
}
