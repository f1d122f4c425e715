// SPDX-License-Identifier: MIT
/// \file
/// Zonal light against integrals over the sphere and against closed forms; what the seed's approximation is worth.
#include <pellucid/reference/environment.hpp>
#include <pellucid/reference/sky.hpp>
#include <cstdio>
#include <vector>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;

namespace {
glm::dvec3 at_height(double y) {
    return {std::sqrt(1 - y * y), y, 0};
}
double largest(glm::dvec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}
}  // namespace

TEST_CASE("zonal diffuse light: closed forms", "[cpu]") {
    // Straight up, E/π = ∫ f 2h dh; of h^0.4 over the upper half: 2/2.4.
    const auto power = [](double h) { return std::pow(std::max(h, 0.0), 0.4); };
    CHECK(zonal_diffuse(power, 1.0) == Approx(2 / 2.4).epsilon(1e-12));
    CHECK(zonal_diffuse(power, -1.0) == Approx(0).margin(1e-15));
    // A white upper half: (1 + y)/2; h itself: 2/3 y.
    const auto half = [](double h) { return h > 0 ? 1.0 : 0.0; };
    for (const double y : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
        CHECK(zonal_diffuse(half, y) == Approx((1 + y) / 2).margin(1e-12));
        CHECK(zonal_diffuse([](double h) { return h; }, y) == Approx(2 * y / 3).margin(1e-12));
    }
    // The values that the seed's constant is measured against below.
    const auto sky = [](double h) { return sky_radiance(Sky{}, h); };
    CHECK(glm::length(zonal_diffuse(sky, 1.0) - glm::dvec3(0.35, 0.6 - 0.1 / 1.2, 0.5 + 0.4 / 1.2)) < 1e-7);
    CHECK(glm::length(zonal_diffuse(sky, -1.0) - glm::dvec3(0.6 - 0.5 / 1.2, 0.6 - 0.52 / 1.2, 0.5 - 0.44 / 1.2)) <
          1e-7);
}

TEST_CASE("zonal integrals agree with integrals over the sphere, and converge", "[cpu]") {
    const Sky sky;
    const auto zonal = [&](double y) { return sky_radiance(sky, y); };
    const auto sphere = [&](glm::dvec3 d) { return sky_radiance(sky, d.y); };
    for (const double y : {-1.0, -0.6, -0.02, 0.0, 0.1, 0.9, 1.0}) {
        INFO("y " << y);
        CHECK(largest(zonal_diffuse(zonal, y) - diffuse_radiance(sphere, at_height(y), 128)) < 1e-4);
        for (const double roughness : {0.1, 0.3, 0.6, 1.0}) {
            INFO("roughness " << roughness);
            const double alpha = roughness * roughness;
            const glm::dvec3 fine = zonal_prefiltered(zonal, y, alpha);
            CHECK(largest(fine - prefiltered_radiance(sphere, at_height(y), alpha, 128)) < 1e-4);
            CHECK(largest(fine - zonal_prefiltered(zonal, y, alpha, 0.25)) < 1e-6);
            CHECK(largest(fine - zonal_prefiltered(zonal, y, alpha, 0.0625)) < 1e-9);
        }
        CHECK(largest(zonal_prefiltered(zonal, y, 1.0) - zonal_diffuse(zonal, y)) < 1e-9);
        CHECK(zonal_prefiltered(zonal, y, 0.0) == zonal(y));
        CHECK(largest(zonal_prefiltered(zonal, y, 1e-6) - zonal(y)) < 0.01);  // (2α)^0.4 at the horizon
    }
}

TEST_CASE("the sky at its ends, at the horizon, and beyond what a unit vector has", "[cpu]") {
    const Sky sky;
    CHECK(sky_radiance(sky, 1.0) == glm::dvec3(sky.zenith));
    CHECK(sky_radiance(sky, -1.0) == glm::dvec3(sky.nadir));
    CHECK(sky_radiance(sky, 0.0) == glm::dvec3(sky.horizon));
    CHECK(sky_radiance(sky, -0.0) == glm::dvec3(sky.horizon));
    CHECK(sky_radiance(sky, 1.0000001) == glm::dvec3(sky.zenith));
    CHECK(sky_radiance(sky, -1.0000001f) == sky.nadir);
    CHECK(sky_radiance(sky, 0.5).x == Approx(0.6 - 0.3 * std::pow(0.5, 0.4)));
    CHECK(sky_radiance(sky, -0.5).x == Approx(0.6 - 0.5 * std::pow(0.5, 0.4)));
}

TEST_CASE("what mixing towards a constant is worth", "[cpu]") {
    const Sky sky;
    const auto zonal = [&](double y) { return sky_radiance(sky, y); };
    // As diffuse light: from half the light above to three times that below.
    double lowest = 1, highest = 1;
    for (int i = -100; i <= 100; ++i) {
        const glm::dvec3 ratio = seed_environment(sky, i / 100.0, 1) / zonal_diffuse(zonal, i / 100.0, 0.25);
        lowest = std::min({lowest, ratio.x, ratio.y, ratio.z});
        highest = std::max({highest, ratio.x, ratio.y, ratio.z});
    }
    std::printf("seed, diffuse: %.3f to %.3f of the exact light\n", lowest, highest);
    CHECK(lowest == Approx(0.48).margin(0.005));
    CHECK(highest == Approx(3.0).margin(0.005));
    // As glossy light, over directions spread evenly in height.
    const struct { double roughness, max; } known[] = {{0.25, 0.27}, {0.5, 0.68}, {0.75, 1.21}, {1.0, 2.00}};
    for (const auto& one : known) {
        double sum = 0, max = 0;
        for (int i = -100; i <= 100; ++i) {
            const double y = i / 100.0, alpha = one.roughness * one.roughness;
            const glm::dvec3 error =
                seed_environment(sky, y, one.roughness) / zonal_prefiltered(zonal, y, alpha, 0.25) - 1.0;
            sum += (std::abs(error.x) + std::abs(error.y) + std::abs(error.z)) / 3;
            max = std::max(max, largest(error));
        }
        std::printf("seed, roughness %.2f: mean error %.1f %%, largest %.1f %%\n", one.roughness, sum / 201 * 100,
                    max * 100);
        CHECK(max == Approx(one.max).margin(0.01));
    }
}
