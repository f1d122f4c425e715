// SPDX-License-Identifier: MIT
/// \file
/// Rules of integration against integrals in closed form.
#include <pellucid/reference/quadrature.hpp>
#include "support/catch.hpp"

using namespace pellucid::reference;

TEST_CASE("Gauss-Legendre rules are exact to degree 2n - 1", "[cpu]") {
    for (const std::size_t n : {1u, 2u, 3u, 7u, 16u, 64u, 257u}) {
        const QuadratureRule rule = gauss_legendre(n);
        REQUIRE(rule.size() == n);
        for (const std::size_t degree : {std::size_t{0}, n - 1, 2 * n - 1}) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i)
                sum += rule.weight[i] * std::pow(rule.at[i], static_cast<double>(degree));
            CHECK(sum == Approx(1 / (static_cast<double>(degree) + 1)).epsilon(1e-13));
        }
        for (std::size_t i = 1; i < n; ++i) CHECK(rule.at[i - 1] < rule.at[i]);
        CHECK(rule.at[0] > 0);
        CHECK(rule.at[n - 1] < 1);
    }
}

TEST_CASE("the tanh-sinh rule does not mind singular ends", "[cpu]") {
    const double pi = std::numbers::pi;
    CHECK(integrate([](double x) { return std::exp(x); }, 0, 1) == Approx(std::exp(1.0) - 1).epsilon(1e-12));
    CHECK(integrate([](double x) { return std::pow(x, 0.4); }, 0, 1) == Approx(1 / 1.4).epsilon(1e-12));
    CHECK(integrate([](double x) { return 1 / std::sqrt(x); }, 0, 4) == Approx(4).epsilon(1e-7));
    CHECK(integrate([](double x) { return std::sqrt(1 - x * x); }, -1, 1) == Approx(pi / 2).epsilon(1e-12));
    CHECK(integrate([](double x) { return std::log(x); }, 0, 1) == Approx(-1).epsilon(1e-12));
    CHECK(integrate([](double x) { return std::exp(x); }, 0, 1, 0.25) == Approx(std::exp(1.0) - 1).epsilon(1e-7));
    CHECK(integrate([](double) { return 1.0; }, 3, 3) == 0);
    CHECK(integrate([](double x) { return x; }, 2, 0) == Approx(-2));
}
