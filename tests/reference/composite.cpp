// SPDX-License-Identifier: MIT
#include <cmath>
#include <pellucid/reference/composite.hpp>
#include "support/catch.hpp"

using namespace pellucid::reference;

TEST_CASE("layers of one colour approach it by (1 - alpha)^n", "[cpu]") {
    for (const double alpha : {0.0, 1 / 255.0, 0.25, 254 / 255.0, 1.0})
        for (const int n : {0, 1, 2, 7, 100}) {
            Composite c;
            for (int i = 0; i < n; ++i) c.put_behind(alpha * glm::dvec3(3, 2, 1), alpha);
            const double left = std::pow(1 - alpha, n);
            CAPTURE(alpha, n);
            CHECK(c.transmittance == Approx(left).epsilon(1e-13));
            const glm::dvec3 all = c.over({0.5, 8, 0});
            CHECK(all.x == Approx(3 * (1 - left) + 0.5 * left).epsilon(1e-13));
            CHECK(all.y == Approx(2 * (1 - left) + 8 * left).epsilon(1e-13));
            CHECK(all.z == Approx(1 - left).epsilon(1e-13));
        }
}

TEST_CASE("compositing is over, nearest first", "[cpu]") {
    Composite c;
    c.put_behind({0.5, 0, 0}, 0.5);
    c.put_behind({0, 0.25, 0}, 0.25);
    c.put_behind({0, 0, 1}, 0);  // light without a surface: added, hides nothing
    CHECK(c.color == glm::dvec3(0.5, 0.125, 0.375));
    CHECK(c.transmittance == 0.375);
    CHECK(c.over({1, 1, 1}) == glm::dvec3(0.875, 0.5, 0.75));
    c.put_behind({9, 9, 9}, 1);
    c.put_behind({7, 7, 7}, 1);  // hidden
    CHECK(c.over({5, 5, 5}) == c.color);
    CHECK(c.color.x == 0.5 + 0.375 * 9);
}
