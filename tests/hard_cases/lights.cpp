// SPDX-License-Identifier: MIT
// Punctual lights at the ends of their ranges, as near as may be, in narrow cones, in any number; and what the usual
// formulae make of it.
#include <numbers>
#include "hard_cases/lit_pixels.hpp"
#include "support/light_cases.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {
constexpr double pi = std::numbers::pi, degree = pi / 180;

/// A white floor that is seen from 3 m above; the middle of the picture looks straight down at the world's origin.
Scene white_floor() {
    Scene scene;
    add(scene, make_plane(100, 100), matte({1, 1, 1}));
    return scene;
}
Camera from_above() {
    return {.near = 0.01, .world_from_view = look_at({0, 3, 0}, {0, 0, 0}, {0, 0, -1})};
}
/// Radiance of the origin.
template <rhi::Backend B>
glm::dvec3 at_origin(typename B::Device& device, const Scene& scene, RenderSettings settings) {
    constexpr std::uint32_t n = 17;
    settings.size = {n, n};
    const auto shot = shoot<B>(device, scene, from_above(), settings);
    const float* t = shot.hdr.texel(n / 2, n / 2);
    return {t[0], t[1], t[2]};
}
template <rhi::Backend B>
glm::dvec3 at_origin(typename B::Device& device, const Scene& scene) {
    return at_origin<B>(device, scene, settings_for(1));
}

/// Whether the radiance that a light makes at the origin is `wanted` times its intensity, to `relative` of it: sharper
/// than one stored value tells.  A light that is so much brighter must reach the next half, one that is so much darker
/// must not.
template <rhi::Backend B>
bool makes(typename B::Device& device, Scene scene, Light light, double wanted, double relative, Brdf brdf) {
    const double half = half_below(0.7);
    RenderSettings settings = settings_for(1);
    settings.brdf = brdf;
    const auto with = [&](double intensity) {
        light.intensity = static_cast<float>(intensity);
        scene.lights = {light};
        return at_origin<B>(device, scene, settings).x;
    };
    return with(half * (1 + relative) / wanted) >= half && with(half * (1 - relative) / wanted) < half;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: one candela at one metre on white, to 1e-5", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // N = V = L, roughness 1: Lambert's 1/pi, of which F = 0.04 is taken, and 0.04 D V = 0.04/(4 pi).  Blinn-Phong's
    // diffuse part is Lambert's whole, its highlight the same.
    for (const double d : {0.25, 1.0, 2.0}) {
        INFO("at " << d << " m");
        const Light lamp{.position = {0, d, 0}};
        CHECK(makes<TestType>(*device, white_floor(), lamp, 0.97 / pi / (d * d), 1e-5, Brdf::gltf));
        CHECK(makes<TestType>(*device, white_floor(), lamp, 1.01 / pi / (d * d), 1e-5, Brdf::blinn_phong));
        CHECK_FALSE(makes<TestType>(*device, white_floor(), lamp, 1.00002 * 0.97 / pi / (d * d), 1e-5, Brdf::gltf));
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: on the axis of a spot of any width, to 1e-5", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const double outer : {0.05, 0.25, 0.5, 1.0, 2.0, 10.0, 90.0})
        for (const double share : {0.0, 0.9, 0.999}) {
            INFO("outer " << outer << " deg, inner " << share << " of it");
            const Light spot{.kind = LightKind::spot,
                             .inner_cone = share * outer * degree,
                             .outer_cone = outer * degree,
                             .position = {0, 1, 0},
                             .direction = {0, -1, 0}};
            CHECK(makes<TestType>(*device, white_floor(), spot, 0.97 / pi, 1e-5, Brdf::gltf));
        }
}

TEST_CASE("hard cases: what biased cones make of the axis of narrow spots", "[cpu]") {
    // inner = 0.9 outer.  (cos θ − cos o)/(cos i − cos o + 1e-4), and KHR_lights_punctual's sample code,
    // ((cos θ − cos o)/max(0.001, cos i − cos o))².
    const auto cosines = [](double outer) { return std::pair(std::cos(0.9 * outer), std::cos(outer)); };
    const auto seed = [&](double degrees) {
        const auto [inner, outer] = cosines(degrees * degree);
        return (1 - outer) / (inner - outer + 1e-4);
    };
    const auto sample_code = [&](double degrees) {
        const auto [inner, outer] = cosines(degrees * degree);
        return std::pow(std::min((1 - outer) / std::max(0.001, inner - outer), 1.0), 2);
    };
    CHECK(seed(0.25) == Approx(0.09).margin(0.005));
    CHECK(seed(0.5) == Approx(0.36).margin(0.005));
    CHECK(sample_code(1) == Approx(0.023).margin(0.001));
    CHECK(sample_code(2) == Approx(0.37).margin(0.005));
    const glm::dvec3 axis(0, -1, 0);
    for (const double degrees : {0.05, 0.25, 0.5, 1.0, 2.0}) {
        const double outer = degrees * degree;
        CHECK(reference::spot_factor(reference::spot_cone(0.9 * outer, outer), axis, -axis) == Approx(1).margin(1e-5));
        // In float, the cosine of an angle well inside of the narrowest cone is that of the axis.
        if (degrees <= 0.05) CHECK(std::cos(static_cast<float>(0.2 * outer)) == 1.0f);
    }
}

TEST_CASE("hard cases: cosines in place of a spot's angles are refused", "[cpu]") {
    for (const double outer : {1.0, 10.0, 30.0, 45.0, 89.0, 90.0})
        for (const double share : {0.0, 0.5, 0.9}) {
            Light spot{.kind = LightKind::spot, .inner_cone = share * outer * degree, .outer_cone = outer * degree};
            CHECK(check_light(spot, 0));
            spot.inner_cone = std::cos(spot.inner_cone);
            spot.outer_cone = std::cos(spot.outer_cone);
            CHECK_FALSE(check_light(spot, 0));  // the cosine of the smaller angle is the larger one
        }
}

TEST_CASE("hard cases: lights close to a plane, and what a biased square of the distance makes of them", "[cpu]") {
    // The light's disc, integrated: a sphere of radius r around a light of 1 cd at height d gives E = Σ L cos θ dω.
    const auto sphere_light = [](double d, double r) {
        const double radiance = 1 / (pi * r * r), edge = std::asin(r / d);
        double sum = 0;
        constexpr int steps = 2000;
        for (int i = 0; i < steps; ++i) {
            const double theta = edge * (i + 0.5) / steps;
            sum += radiance * std::cos(theta) * 2 * pi * std::sin(theta) * edge / steps;
        }
        return sum;
    };
    struct Case {
        double distance, biased;
    };
    for (const Case& c : {Case{1e-3, -0.99}, Case{1e-2, -0.5}, Case{0.1, -0.01}}) {
        const double exact = sphere_light(c.distance, 0.9 * c.distance);
        CHECK(reference::distance_falloff(c.distance, 0) == Approx(exact).epsilon(0.01));
        CHECK(1 / (c.distance * c.distance + 1e-4) / exact - 1 == Approx(c.biased).margin(0.001));
    }
    // On the surface: 1/d² is infinite and the direction NaN; a range of 0 is a division of 0 by 0.
    const float zero = 0.0f;
    CHECK(std::isinf(1.0f / (zero * zero)));
    CHECK(std::isnan(glm::normalize(glm::vec3(zero)).x));
    CHECK(std::isnan(zero / zero));
    CHECK(std::isfinite(reference::distance_falloff(0, 0)));
    CHECK(std::isfinite(reference::distance_falloff(0, 5)));
    CHECK(std::isfinite(reference::sample_light({}, {0, 0, 0}).illuminance.x));
}

TEMPLATE_LIST_TEST_CASE("hard cases: 0 to 1024 lights in one place, by every method", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const std::uint32_t count : {0u, 1u, 16u, 17u, 256u, 1024u}) {
        Scene scene = white_floor();
        // All green but the last one: whoever drops lights beyond a limit sees no red.
        for (std::uint32_t i = 0; i < count; ++i) {
            scene.lights.push_back(lamp({0, 1, 0}, 2, i + 1 == count ? 1.0f : 1.0f / 64));
            scene.lights.back().color = i + 1 == count ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        }
        const double one = 0.97 / pi * (1 - 1.0 / 16);
        for (const LightAssignment method :
             {LightAssignment::loop, LightAssignment::volumes, LightAssignment::tiled, LightAssignment::clustered}) {
            RenderSettings settings = settings_for(1);
            settings.lighting = method;
            const glm::dvec3 got = at_origin<TestType>(*device, scene, settings);
            INFO(count << " lights, " << name(method) << ": " << got.x << ", " << got.y);
            // Volumes round once more, where they are added to what the lighting pass wrote.
            const double relative = method == LightAssignment::volumes ? 1e-4 + half_step : 1e-4;
            CHECK(is_stored(got.x, count > 0 ? one : 0.0, relative));
            CHECK(is_stored(got.y, count > 0 ? one * (count - 1) / 64 : 0.0, relative));
            CHECK(got.z == 0.0);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: lights on the borders and corners of tiles, bit for bit", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 4 * PELLUCID_LIGHTS_TILE;
    Scene wall;
    add(wall, quad(2, 2), matte({1, 1, 1}, 0.5f));
    // Both views see a square of 2 m; a tile is half a metre at z = 0.
    const Camera perspective{.vertical_fov = 2 * std::atan(0.1), .world_from_view = at(0, 0, 10)};
    for (const Camera& camera : {flat_camera(), perspective}) {
        for (const float range : {0.03f, 0.25f, std::nextafter(0.25f, 0.0f), std::nextafter(0.25f, 1.0f), 0.5f}) {
            // Round corners and borders of tiles, touching the next ones to the ulp, and up to the borders from inside.
            Scene scene = wall;
            for (const double x : {0.0, 0.25, 0.5, -1.0})
                for (const glm::dvec3& place :
                     {glm::dvec3(x, x, 0), glm::dvec3(x, 0.25, 0.01), glm::dvec3(-0.5, x, 0.02)})
                    scene.lights.push_back(lamp(place, range, 0.1f));
            RenderSettings settings = settings_for(n);
            settings.exact = true;
            settings.lighting = LightAssignment::loop;
            const auto loop = shoot<TestType>(*device, scene, camera, settings);
            CHECK(std::any_of(loop.hdr.data.begin(), loop.hdr.data.end(), [](float v) { return v > 0 && v != 1; }));
            for (const LightAssignment method : {LightAssignment::tiled, LightAssignment::clustered}) {
                settings.lighting = method;
                const auto lists = shoot<TestType>(*device, scene, camera, settings);
                INFO(name(method) << ", range " << range);
                CHECK(different_pixels(loop.hdr, lists.hdr) == 0);
            }
        }
    }
}
