// SPDX-License-Identifier: MIT
/// \file
/// Environments as pictures: where a direction is in one, and the integrals over them.
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/environment.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::Random;

namespace {

constexpr double pi = std::numbers::pi;

bool near(glm::dvec3 a, glm::dvec3 b, double tolerance) {
    return glm::length(a - b) <= tolerance;
}

/// A picture of f at the middle of each texel.
template <class F>
ImageF picture(std::uint32_t height, const F& f) {
    ImageF image(2 * height, height, 3);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const glm::dvec3 value = f(equirect_direction({(x + 0.5) / image.width, (y + 0.5) / height}));
            for (int c = 0; c < 3; ++c) image.texel(x, y)[c] = static_cast<float>(value[c]);
        }
    return image;
}

/// Smooth, positive, different in each channel and along each axis.
glm::dvec3 smooth(glm::dvec3 d) {
    return {2 + d.x, 2 + d.y * d.y + 0.5 * d.z, 1.5 + d.z * d.x};
}

}  // namespace

TEST_CASE("a direction is where three.js and Khronos' sampler have it", "[cpu]") {
    const auto is_at = [](glm::dvec3 d, double u, double v) {
        const glm::dvec2 uv = equirect_uv(d);
        return std::abs(uv.x - u) < 1e-15 && std::abs(uv.y - v) < 1e-15;
    };
    CHECK(is_at({1, 0, 0}, 0.5, 0.5));
    CHECK(is_at({0, 0, -1}, 0.25, 0.5));
    CHECK(is_at({0, 0, 1}, 0.75, 0.5));
    CHECK(is_at({-1, 0, 0}, 1, 0.5));
    CHECK(is_at({-1, 0, -0.0}, 0, 0.5));
    CHECK(is_at({0, 1, 0}, 0.5, 0));
    CHECK(is_at({0, -1, 0}, 0.5, 1));
    CHECK(is_at(glm::normalize(glm::dvec3(1, 1, 0)), 0.5, 0.25));
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 d = random.direction();
        CHECK(near(equirect_direction(equirect_uv(d)), d, 1e-14));
    }
    // Near the pole the distance from it keeps its digits.
    CHECK(equirect_uv({1e-12, 1, 0}).y == Approx(1e-12 / pi).epsilon(1e-12));
}

TEST_CASE("lookups are bilinear, wrap around and stop at the poles", "[cpu]") {
    ImageF image(4, 2, 3);
    for (std::uint32_t y = 0; y < 2; ++y)
        for (std::uint32_t x = 0; x < 4; ++x) image.texel(x, y)[0] = static_cast<float>(10 * y + x);
    const auto at = [&](double u, double v) { return environment_radiance(image, equirect_direction({u, v})).x; };
    for (std::uint32_t y = 0; y < 2; ++y)
        for (std::uint32_t x = 0; x < 4; ++x)
            CHECK(at((x + 0.5) / 4, (y + 0.5) / 2) == Approx(10 * y + x).margin(1e-12));
    CHECK(at(0.5, 0.25) == Approx(1.5));
    CHECK(at(0.5, 0.5) == Approx(6.5));
    CHECK(at(0.0625, 0.25) == Approx(0.25 * 3).margin(1e-12));  // a quarter before the first texel: the last one
    CHECK(at(0.9375, 0.25) == Approx(0.75 * 3).margin(1e-12));
    CHECK(at(0.375, 0.01) == Approx(1));
    CHECK(at(0.375, 0.99) == Approx(11));
    CHECK(std::isfinite(environment_radiance(image, {0, 1, 0}).x));
    CHECK(environment_radiance(image, {-1, 0, 0}).x == Approx(environment_radiance(image, {-1, 0, -0.0}).x));
    // The smallest one.
    ImageF two(2, 1, 3);
    two.texel(0, 0)[1] = 4;
    CHECK(environment_radiance(two, equirect_direction({0.25, 0.2})).y == Approx(4));
    CHECK(environment_radiance(two, {1, 0, 0}).y == Approx(2));
    CHECK(environment_radiance(two, {-1, 0, 0}).y == Approx(2));
}

TEST_CASE("frames are orthonormal and right-handed", "[cpu]") {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = i == 0 ? glm::dvec3(0, 0, -1) : i == 1 ? glm::dvec3(0, 0, 1) : random.direction();
        const Frame frame(axis);
        CHECK(near(glm::cross(frame.x, frame.y), axis, 1e-15));
        CHECK(std::abs(glm::dot(frame.x, frame.y)) < 1e-15);
        CHECK(glm::length(frame.x) == Approx(1).epsilon(1e-15));
        CHECK(near(frame.to_world({0, 0, 1}), axis, 0));
    }
}

TEST_CASE("the lobe's weight is D(H) N.L / 4, and its total is in closed form", "[cpu]") {
    Random random(3);
    for (const double alpha : {0.002, 0.05, 0.3, 0.7, 0.71, 0.95, 1.0}) {
        const glm::dvec3 n = random.direction();
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 l = random.direction_above(n);
            const double expected = ggx_distribution(n, n + l, alpha) * glm::dot(n, l) / 4;
            CHECK(prefilter_weight(1 - glm::dot(n, l), alpha) == Approx(expected).epsilon(1e-9));
        }
        CHECK(prefilter_weight(1.5, alpha) == 0);
        // Over 1 − μ, split at the width of the lobe.
        const auto weight = [&](double gap) { return 2 * pi * prefilter_weight(gap, alpha); };
        const double width = alpha * alpha;
        const double total = integrate(weight, 0, width) + integrate(weight, width, std::sqrt(width)) +
                             integrate(weight, std::sqrt(width), 1);
        CHECK(prefilter_total(alpha) == Approx(total).epsilon(1e-8));
    }
    CHECK(prefilter_total(1.0) == 0.25);
    CHECK(prefilter_total(1e-9) == Approx(1));
}

TEST_CASE("a constant environment is what all integrals return", "[cpu]") {
    const auto constant = [](glm::dvec3) { return glm::dvec3(0.25, 1, 3); };
    const ImageF image = picture(16, constant);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -3));
    CHECK(near(diffuse_radiance(constant, axis), constant(axis), 1e-13));
    CHECK(near(integrate_image(
                   image, [](glm::dvec3) { return 1.0; }, 4),
               4 * pi * constant(axis), 1e-5));
    CHECK(near(diffuse_radiance(image, axis, 4), constant(axis), 5e-3));
    for (const double alpha : {0.0, 0.01, 0.3, 1.0})
        CHECK(near(prefiltered_radiance(constant, axis, alpha), constant(axis), 1e-13));
    CHECK(near(prefiltered_radiance(image, axis, 0.3, 4), constant(axis), 5e-3));
}

TEST_CASE("first and second harmonics come back scaled as theory says", "[cpu]") {
    // E/π of l·a is 2/3 n·a, of (l·a)² − 1/3 is 1/4 ((n·a)² − 1/3) (Ramamoorthi and Hanrahan 2001).
    Random random(4);
    for (int i = 0; i < 10; ++i) {
        const glm::dvec3 a = random.direction(), n = random.direction();
        const auto radiance = [&](glm::dvec3 l) {
            const double c = glm::dot(l, a);
            return glm::dvec3(c, c * c - 1.0 / 3, 1);
        };
        const double c = glm::dot(n, a);
        CHECK(near(diffuse_radiance(radiance, n, 16), {2.0 / 3 * c, (c * c - 1.0 / 3) / 4, 1}, 1e-12));
    }
}

TEST_CASE("at roughness 1 prefiltered light is diffuse light", "[cpu]") {
    Random random(5);
    const ImageF image = picture(32, smooth);
    for (int i = 0; i < 5; ++i) {
        const glm::dvec3 n = random.direction();
        CHECK(near(prefiltered_radiance(smooth, n, 1.0), diffuse_radiance(smooth, n), 1e-12));
        CHECK(near(prefiltered_radiance(image, n, 1.0), diffuse_radiance(image, n), 1e-12));
    }
}

TEST_CASE("integrals over a picture agree with integrals over its radiance function", "[cpu]") {
    const ImageF image = picture(64, smooth);
    const auto radiance = [&](glm::dvec3 l) { return environment_radiance(image, l); };
    Random random(6);
    for (const double alpha : {0.2, 0.5, 1.0}) {
        const glm::dvec3 n = random.direction();
        const glm::dvec3 by_texels = prefiltered_radiance(image, n, alpha, 4);
        CHECK(near(by_texels, prefiltered_radiance(radiance, n, alpha, 128), 2e-4));
        CHECK(near(by_texels, prefiltered_radiance(smooth, n, alpha), 2e-3));  // what bilinear texels lose
    }
    const glm::dvec3 n = random.direction();
    CHECK(near(diffuse_radiance(image, n, 4), diffuse_radiance(radiance, n, 128), 2e-4));
}

TEST_CASE("one texel that outshines the rest is weighed by its place and size", "[cpu]") {
    // 2,000 times the background in one texel, as a sun is: its light is its solid angle times the lobe there.
    ImageF image = picture(128, [](glm::dvec3) { return glm::dvec3(1.0); });
    const std::uint32_t x = 70, y = 40;
    for (int c = 0; c < 3; ++c) image.texel(x, y)[c] = 2001;
    const glm::dvec2 uv((x + 0.5) / 256, (y + 0.5) / 128);
    const glm::dvec3 sun = equirect_direction(uv);
    const double solid_angle = 2 * pi * pi / (256 * 128) * std::sin(pi * uv.y);
    for (const double angle : {0.0, 0.3, 1.0}) {
        const glm::dvec3 axis = pellucid::test::tilted(sun, angle, 1.0);
        const double alpha = 0.4, weight = prefilter_weight(1 - glm::dot(axis, sun), alpha) / prefilter_total(alpha);
        CHECK(prefiltered_radiance(image, axis, alpha, 3).x == Approx(1 + 2000 * solid_angle * weight).epsilon(5e-3));
    }
}
