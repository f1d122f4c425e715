// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/brdf.hpp>
#include "lobes.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;
using pellucid::test::angle_between;
using pellucid::test::Random;
using pellucid::test::textbook_distribution;
using pellucid::test::tilted;

namespace {

constexpr double pi = std::numbers::pi;

/// Largest relative error of D in float, over half vectors within tan θ <= 2α of the normal, against D in double of the
/// same stored vectors.  `stored_half`: the half vector itself is stored; else V and L are, and float adds them.
template <class F>
double worst_distribution_error(double roughness, bool stored_half, F&& distribution) {
    Random random(7);
    const auto alpha = static_cast<float>(roughness * roughness);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 n = random.direction();
        const glm::dvec3 h = tilted(n, std::atan(2.0 * alpha * random.uniform()), random.uniform(0, 2 * pi));
        const glm::dvec3 v = tilted(h, random.uniform(0, 1.2), random.uniform(0, 2 * pi));
        const glm::vec3 nf(n), hf(h), vf(v), lf(2.0 * glm::dot(v, h) * h - v);
        const glm::dvec3 half = stored_half ? glm::dvec3(hf) : glm::dvec3(vf) + glm::dvec3(lf);
        const double exact = textbook_distribution(angle_between(glm::dvec3(nf), half), alpha);
        const double error = std::abs(distribution(nf, stored_half ? hf : vf + lf, alpha) / exact - 1.0);
        worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
    }
    return worst;
}

}  // namespace

TEST_CASE("the GGX distribution equals its textbook form", "[cpu]") {
    Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const double alpha = std::exp(random.uniform(std::log(2e-3), 0.0));
        const double theta = random.uniform(0, 1.5);
        const glm::dvec3 n = random.direction(), h = tilted(n, theta, random.uniform(0, 6));
        REQUIRE(ggx_distribution(n, h * random.uniform(0.01, 2), alpha) ==
                Approx(textbook_distribution(theta, alpha)).epsilon(1e-10));
    }
}

TEST_CASE("the peak of D is 1/(pi alpha^2), down to the smoothest 8-bit roughness", "[cpu]") {
    const glm::dvec3 n(0, 1, 0);
    CHECK(ggx_distribution(n, n, 1e-3) == Approx(318309.886).epsilon(1e-8));
    for (int code = 1; code <= 3; ++code) {
        const double alpha = code / 255.0 * code / 255.0;
        CHECK(ggx_distribution(n, n, alpha) == Approx(1 / (pi * alpha * alpha)).epsilon(1e-12));
        CHECK(ggx_distribution(glm::vec3(n), glm::vec3(n), static_cast<float>(alpha)) ==
              Approx(1 / (pi * alpha * alpha)).epsilon(1e-5));
    }
    CHECK(ggx_distribution(n, n, 0.0) == 0.0);
    CHECK(ggx_distribution(n, glm::dvec3(0.6, 0.8, 0), 0.0) == 0.0);
}

TEST_CASE("D in float keeps its digits where the usual form loses them", "[cpu]") {
    const auto ours = [](glm::vec3 n, glm::vec3 half, float alpha) {
        return static_cast<double>(ggx_distribution(n, half, alpha));
    };
    const auto seed = [](glm::vec3 n, glm::vec3 half, float alpha) {
        return static_cast<double>(
            seed_distribution(std::max(glm::dot(n, glm::normalize(half)), 0.0f), std::sqrt(alpha)));
    };
    for (const double roughness : {1 / 255.0, 3 / 255.0, 0.02, 0.045, 0.2, 1.0})
        CHECK(worst_distribution_error(roughness, true, ours) < 1.5e-6);
    CHECK(worst_distribution_error(1 / 255.0, false, ours) < 8e-3);
    CHECK(worst_distribution_error(3 / 255.0, false, ours) < 1e-3);
    CHECK(worst_distribution_error(0.045, false, ours) < 6e-5);
    CHECK(worst_distribution_error(0.2, false, ours) < 4e-6);
    CHECK(worst_distribution_error(3 / 255.0, true, seed) == std::numeric_limits<double>::infinity());
    CHECK(worst_distribution_error(0.045, true, seed) > 0.05);
}

TEST_CASE("visibility has its closed form at N.L = 1, also at grazing views", "[cpu]") {
    for (const double alpha : {2.025e-3, 0.01, 0.25, 1.0})
        for (const double n_dot_v : {0.0, 1e-6, 1e-3, 0.01, 0.5, 1.0}) {
            const double exact = 0.5 / (std::sqrt(n_dot_v * n_dot_v * (1 - alpha * alpha) + alpha * alpha) + n_dot_v);
            CHECK(smith_visibility(n_dot_v, 1.0, alpha) == Approx(exact).epsilon(1e-12));
            CHECK(smith_visibility(static_cast<float>(n_dot_v), 1.0f, static_cast<float>(alpha)) ==
                  Approx(exact).epsilon(1e-6));
        }
    CHECK(smith_visibility(0.0, 0.0, 0.5) == 0.0);
    CHECK(smith_visibility(0.5, 0.0, 0.0) == 0.0);
    // Rough limit: α = 1 gives ½/(N·L + N·V).
    CHECK(smith_visibility(0.3, 0.6, 1.0) == Approx(0.5 / 0.9).epsilon(1e-14));
}

TEST_CASE("Fresnel and F0 have their end points", "[cpu]") {
    const glm::dvec3 f0(0.04, 0.5, 1.0);
    CHECK(schlick_fresnel(f0, 1.0) == f0);
    CHECK(schlick_fresnel(f0, 0.0) == glm::dvec3(1.0));
    CHECK(schlick_fresnel(f0, -0.5) == glm::dvec3(1.0));
    CHECK(schlick_fresnel(f0, 1.0000001) == f0);
    CHECK(schlick_fresnel(glm::dvec3(0.0), 0.5).x == Approx(1 / 32.0).epsilon(1e-14));
    CHECK(normal_reflectance(Surface<double>{.base_color = {0.2, 0.4, 0.6}, .metallic = 1}).y ==
          Approx(0.4).epsilon(1e-14));
    CHECK(normal_reflectance(Surface<double>{.metallic = 0.5}).x == Approx(0.52).epsilon(1e-14));
}
