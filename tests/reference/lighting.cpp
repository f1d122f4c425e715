// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/reference/tonemap.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::tilted;

namespace {
constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("one candela at one metre on white Lambert is 1/pi", "[cpu]") {
    const Surface<double> white{.normal = {0, 1, 0}};
    const Light lamp{.kind = LightKind::point, .position = {0, 1, 0}};
    const LightSample sample = sample_light(lamp, {0, 0, 0});
    CHECK(sample.illuminance == glm::dvec3(1.0));
    const BrdfResponse<double> response = evaluate_gltf(white, {0, 1, 0}, sample.to_light);
    CHECK(response.diffuse.x / 0.96 == Approx(1 / pi).epsilon(1e-14));  // F = F0 = 0.04 taken out
    const BrdfResponse<double> lambert = evaluate_blinn_phong(white, {0, 1, 0}, sample.to_light);
    CHECK(lambert.diffuse.x * sample.illuminance.x == Approx(1 / pi).epsilon(1e-14));
    // At 60 degrees from twice as far: cos/d² = 1/8.
    const Light slant{.position = {std::sqrt(3.0), 1, 0}};
    const LightSample far = sample_light(slant, {0, 0, 0});
    CHECK(evaluate_blinn_phong(white, {0, 1, 0}, far.to_light).diffuse.x * far.illuminance.x ==
          Approx(1 / pi / 8).epsilon(1e-14));
}

TEST_CASE("the range window is the extension's: 1/d^2 times 1 - (d/range)^4, exactly 0 outside", "[cpu]") {
    CHECK(distance_falloff(2, 0) == 0.25);
    CHECK(distance_falloff(2, infinity) == 0.25);
    CHECK(distance_falloff(1, 2) == 15.0 / 16.0);
    CHECK(distance_falloff(8, 10) == Approx((1 - 0.4096) / 64).epsilon(1e-14));
    for (const double range : {0.1, 1.0, 3.0, 1e4}) {
        CHECK(distance_falloff(range, range) == 0.0);
        CHECK(distance_falloff(std::nextafter(range, infinity), range) == 0.0);
        CHECK(distance_falloff(2 * range, range) == 0.0);
        const double inside = distance_falloff(std::nextafter(range, 0.0), range);
        CHECK(inside > 0.0);
        CHECK(inside * range * range < 1e-14);
    }
}

TEST_CASE("a light close by is exact down to 1 mm and finite on the surface", "[cpu]") {
    for (const double d : {1e-3, 1e-2, 0.1}) CHECK(distance_falloff(d, 0) == Approx(1 / (d * d)).epsilon(1e-14));
    CHECK(distance_falloff(0, 0) == Approx(1e6).epsilon(1e-14));
    CHECK(distance_falloff(0, 5) == Approx(1e6).epsilon(1e-14));
    const Light lamp{.position = {1, 2, 3}};
    const LightSample sample = sample_light(lamp, {1, 2, 3});
    CHECK(sample.illuminance == glm::dvec3(0.0));
    CHECK(surface_radiance({}, {1, 2, 3}, {0, 0, 1}, {&lamp, 1}, {0, 0, 0}) == glm::dvec3(0.0));
}

TEST_CASE("a spot has its full intensity on the axis and none outside, however narrow", "[cpu]") {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.9, 0.2));
    for (const double degrees : {0.05, 0.25, 0.5, 1.0, 2.0, 2.6, 10.0, 45.0, 90.0})
        for (const double share : {0.0, 0.5, 0.9, 0.999}) {
            const double outer = degrees * pi / 180, inner = share * outer;
            const SpotCone cone = spot_cone(inner, outer);
            CAPTURE(degrees, share);
            CHECK(spot_factor(cone, axis, -axis) == Approx(1).epsilon(1e-12));
            CHECK(spot_factor(cone, axis, -tilted(axis, 0.99 * inner, 1)) == Approx(1).epsilon(1e-9));
            CHECK(spot_factor(cone, axis, -tilted(axis, 1.0001 * outer, 2)) == 0.0);
            CHECK(spot_factor(cone, axis, axis) == 0.0);
            // Between the angles: the square of the linear ramp in cos θ, here from cosines in long double.
            const double theta = 0.4 * inner + 0.6 * outer;
            const auto cosine = [](double a) { return std::cos(static_cast<long double>(a)); };
            const long double ramp = (cosine(theta) - cosine(outer)) / (cosine(inner) - cosine(outer));
            CHECK(spot_factor(cone, axis, -tilted(axis, theta, 3)) ==
                  Approx(static_cast<double>(ramp * ramp)).margin(1e-8));
        }
}

TEST_CASE("equal cone angles are a hard edge", "[cpu]") {
    const SpotCone cone = spot_cone(0.3, 0.3);
    const glm::dvec3 axis(0, 0, -1);
    CHECK(spot_factor(cone, axis, -tilted(axis, 0.3 - 1e-6, 0)) == 1.0);
    CHECK(spot_factor(cone, axis, -tilted(axis, 0.3 + 1e-6, 0)) == 0.0);
}

TEST_CASE("radiance is the sum over lights, plus ambient and emissive", "[cpu]") {
    const Surface<double> surface{
        .normal = {0, 1, 0}, .base_color = {0.5, 0.25, 1}, .roughness = 0.6, .occlusion = 0.5, .emissive = {3, 0, 0}};
    const glm::dvec3 p(0.2, 0, -0.4), v = glm::normalize(glm::dvec3(0.3, 1, 0.2));
    const std::vector<Light> lights = {
        {.kind = LightKind::directional, .color = {1, 0.5f, 0.25f}, .intensity = 10, .direction = {0, -1, 0}},
        {.kind = LightKind::point, .intensity = 4, .range = 5, .position = {1, 2, 0}},
        {.kind = LightKind::spot,
         .intensity = 100,
         .inner_cone = 0.1,
         .outer_cone = 0.4,
         .position = {0.2, 3, -0.4},
         .direction = {0, -1, 0}}};
    const glm::dvec3 none(0.0);
    glm::dvec3 sum(0.0);
    for (const Light& light : lights) sum += surface_radiance(surface, p, v, {&light, 1}, none) - surface.emissive;
    const glm::dvec3 ambient(2, 4, 6);
    const glm::dvec3 all = surface_radiance(surface, p, v, lights, ambient);
    for (int c = 0; c < 3; ++c)
        CHECK(all[c] == Approx(sum[c] + surface.emissive[c] + ambient[c] * surface.base_color[c] * 0.5).epsilon(1e-12));
    CHECK(surface_radiance(surface, p, v, {}, none) == surface.emissive);
    // The directional light alone: E = 10 lx straight down, coloured.
    const glm::dvec3 sun = surface_radiance(surface, p, v, {lights.data(), 1}, none) - surface.emissive;
    const glm::dvec3 f = evaluate_gltf(surface, v, glm::dvec3(0, 1, 0)).total();
    CHECK(sun.y == Approx(f.y * 5).epsilon(1e-12));
    CHECK(sun.z == Approx(f.z * 2.5).epsilon(1e-12));
    // The spot straight above, on its axis: 100 cd at 3 m.
    const LightSample spot = sample_light(lights[2], p);
    CHECK(spot.illuminance.x == Approx(100 / 9.0).epsilon(1e-12));
}

TEST_CASE("the eye is a point or a direction", "[cpu]") {
    Camera camera{.world_from_view = look_at({3, 4, 0}, {0, 0, 0})};
    CHECK(glm::length(direction_to_eye(camera, {0, 0, 0}) - glm::dvec3(0.6, 0.8, 0)) < 1e-15);
    CHECK(glm::length(direction_to_eye(camera, {3, 4, 2}) - glm::dvec3(0, 0, -1)) < 1e-15);
    CHECK(glm::length(direction_to_eye(camera, {3, 4, 0}) - glm::dvec3(0.6, 0.8, 0)) < 1e-15);
    camera.projection = Projection::orthographic;
    CHECK(glm::length(direction_to_eye(camera, {100, -7, 2}) - glm::dvec3(0.6, 0.8, 0)) < 1e-15);
}

TEST_CASE("a sun in the smoothest mirror is finite, and an exposed picture of it can be stored", "[cpu]") {
    const Surface<double> mirror{.normal = {0, 1, 0}, .metallic = 1, .roughness = 0};
    const Light sun{.kind = LightKind::directional, .intensity = 1e5f, .direction = {0, -1, 0}};
    const glm::dvec3 radiance = surface_radiance(mirror, {0, 0, 0}, {0, 1, 0}, {&sun, 1}, {0, 0, 0});
    CHECK(radiance.x == Approx(1e5 / (4 * pi * std::pow(0.045, 4))).epsilon(1e-9));  // far above what binary16 holds
    CHECK(sanitized(radiance) == glm::dvec3(65504.0));
    CHECK(tone_map(ToneMap::neutral, -16.0, radiance).x > 0.7);
    CHECK(tone_map(ToneMap::neutral, -16.0, radiance).x < 1.0);
}
