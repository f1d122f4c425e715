// SPDX-License-Identifier: MIT
// Lighting where the answer is known in closed form, and where arithmetic likes to fail.
#include <limits>
#include <numbers>
#include "support/scene.hpp"

using namespace pellucid;
using test::add;
using test::at;

namespace {
constexpr double pi = std::numbers::pi;
constexpr std::uint32_t n = 65;  // odd: the middle pixel lies on the view's axis

/// Looks down at the floor y = 0 from `height`, x to the right and z towards the bottom.
Camera above(double height, double near = 0.01) {
    return {.near = near, .world_from_view = look_at({0, height, 0}, {0, 0, 0}, {0, 0, -1})};
}
Scene floor_scene(const Material& material = test::matte({1, 1, 1})) {
    Scene scene;
    add(scene, make_plane(100, 100), material);
    return scene;
}
/// Radiance of the middle pixel.
template <rhi::Backend B>
glm::dvec3 lit(typename B::Device& device, const Scene& scene, const Camera& camera) {
    const auto shot = test::shoot<B>(device, scene, camera, test::settings_for(n));
    for (const float v : shot.hdr.data) REQUIRE(std::isfinite(v));
    const float* t = shot.hdr.texel(n / 2, n / 2);
    return {t[0], t[1], t[2]};
}
/// Stored values lie up to 2^-10 below what they are of, and float arithmetic moves them by 1e-5.
bool stored(double got, double wanted, double arithmetic = 1e-5) {
    return got <= wanted * (1 + arithmetic) + 1e-7 && got >= wanted * (1 - 0x1p-10 - arithmetic) - 1e-7;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("one candela above a white floor, in closed form", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = floor_scene();
    // N = V = L, roughness 1: F = 0.04, D V = 1/pi 1/4 · … = 0.25/pi; radiance (0.96 + 0.04/4)/pi a lux.
    const double white = (0.96 + 0.01) / pi;
    for (const double d : {0.5, 1.0, 2.0, 10.0}) {
        scene.lights = {{.position = {0, d, 0}}};
        const glm::dvec3 got = lit<TestType>(*device, scene, above(3));
        INFO("1 cd at " << d << " m: " << got.x << " instead of " << white / (d * d));
        CHECK(stored(got.x, white / (d * d)));
        CHECK((got.x == got.y && got.y == got.z));
    }
    scene.lights = {
        {.kind = LightKind::directional, .color = {1, 0.5f, 0.25f}, .intensity = 3, .direction = {0, -1, 0}}};
    const glm::dvec3 sun = lit<TestType>(*device, scene, above(3));
    CHECK(stored(sun.x, 3 * white));
    CHECK(stored(sun.y, 1.5 * white));
    CHECK(stored(sun.z, 0.75 * white));
    // L = N = V on a mirror-like metal: F0 D(0)/4 = 1/(4 pi a²), a = 0.045² (hard cases 1, 4, 8).
    Scene mirror = floor_scene({.base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = 0});
    mirror.lights = {{.kind = LightKind::directional, .intensity = 0.01f, .direction = {0, -1, 0}}};
    const double peak = 1 / (4 * pi * std::pow(0.045, 4));
    CHECK(stored(lit<TestType>(*device, mirror, above(3)).x, 0.01 * peak, 1e-3));
    // A sun on it is brighter than a half can hold: the largest value, never infinity (14).
    mirror.lights[0].intensity = 1e5f;
    CHECK(lit<TestType>(*device, mirror, above(3)).x == 65504.0);
}

TEMPLATE_LIST_TEST_CASE("lights behind the surface, along the view, and on the surface", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
        Scene scene = floor_scene({.base_color = {1, 1, 1, 1}, .metallic = 0.5f, .roughness = roughness});
        scene.lights = {{.position = {0, -1, 0}}};  // L = -V at the middle (7)
        CHECK(lit<TestType>(*device, scene, above(3)) == glm::dvec3(0));
        scene.lights = {{.kind = LightKind::directional, .direction = {0, 1, 0}}};
        CHECK(lit<TestType>(*device, scene, above(3)) == glm::dvec3(0));
        scene.lights = {{.position = {0, 0, 0}}};  // on the surface (9): finite everywhere
        CHECK(lit<TestType>(*device, scene, above(3)).x >= 0);
        scene.lights = {{.position = {0, 3, 0}}};  // at the eye
        CHECK(lit<TestType>(*device, scene, above(3)).x > 0);
        scene.lights = {{.kind = LightKind::directional, .direction = {1, 0, 0}}};  // grazing, N·L = 0
        CHECK(lit<TestType>(*device, scene, above(3)) == glm::dvec3(0));
    }
    Scene scene = floor_scene();
    for (const double d : {1e-3, 1e-2, 1e-1}) {  // close by (10), 1/d² until 1 mm
        scene.lights = {{.intensity = 1e-4f, .position = {0, d, 0}}};
        const double wanted = 1e-4 * 0.97 / pi / (d * d);
        const double got = lit<TestType>(*device, scene, above(0.25, 0.001)).x;
        INFO("1e-4 cd at " << d << " m: " << got << " instead of " << wanted);
        CHECK(stored(got, std::min(wanted, 65504.0), 1e-4));
    }
}

TEMPLATE_LIST_TEST_CASE("grazing views stay finite and dim as they should", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const float roughness : {0.0f, 0.045f, 0.3f, 1.0f})
        for (const double height : {1.0, 1e-2, 1e-4}) {  // N·V from 0.3 down to 1e-5 (5)
            Scene scene = floor_scene({.base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = roughness});
            scene.lights = {{.kind = LightKind::directional, .direction = {0, -1, 0}},
                            {.kind = LightKind::directional, .direction = glm::normalize(glm::dvec3(0, -0.01, 1))}};
            const Camera camera{.near = 1e-5, .world_from_view = look_at({0, height, 3}, {0, 0, 0})};
            const auto shot = test::shoot<TestType>(*device, scene, camera, test::settings_for(n));
            std::size_t bad = 0;
            for (const float v : shot.hdr.data) bad += !(std::isfinite(v) && v >= 0);
            INFO("roughness " << roughness << ", height " << height);
            CHECK(bad == 0);
            CHECK(shot.hdr.texel(n / 2, n - 1)[0] > 0);
        }
}

TEMPLATE_LIST_TEST_CASE("shading normals that turn away from the eye leave no black and no jump", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    // A wall whose shading normal turns from towards the eye to away from it, left to right (6).
    Scene scene;
    Mesh wall = test::quad();
    wall.normals = {{-0.1f, 0, 0.995f}, {-0.1f, 0, 0.995f}, {0.995f, 0, -0.1f}, {0.995f, 0, -0.1f}};
    add(scene, wall, {.base_color = {1, 1, 1, 1}, .metallic = 0.5f, .roughness = 0.5f});
    scene.lights = {{.kind = LightKind::directional, .direction = glm::normalize(glm::dvec3(-1, 0, -0.3))}};
    const auto shot = test::shoot<TestType>(*device, scene, test::flat_camera(), test::settings_for(256));
    float largest = 0, jump = 0, least = 1e9f;
    for (std::uint32_t x = 1; x < 256; ++x) {
        const float a = shot.hdr.texel(x - 1, 128)[0], b = shot.hdr.texel(x, 128)[0];
        REQUIRE(std::isfinite(b));
        largest = std::max(largest, b);
        jump = std::max(jump, std::abs(b - a));
        if (x > 128) least = std::min(least, b);
    }
    CHECK(least > 0.05f);
    CHECK(jump < 0.05f * largest);
}

TEMPLATE_LIST_TEST_CASE("range: windowed inside, exactly nothing outside", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = floor_scene();
    const double white = 0.97 / pi;
    const float next = std::nextafter(2.0f, 3.0f);
    struct Case {
        double distance;
        float range;
    };
    for (const Case& c : {Case{2, 0}, Case{2, std::numeric_limits<float>::infinity()}, Case{2, 4}, Case{2, 2.2f},
                          Case{2, 2}, Case{2, 1.999f}, Case{2, next}, Case{8, 10}, Case{100, 10}}) {
        scene.lights = {{.intensity = 10, .range = c.range, .position = {0, c.distance, 0}}};
        const double wanted = 10 * white * reference::distance_falloff(c.distance, double{c.range});
        const double got = lit<TestType>(*device, scene, above(3)).x;
        INFO("range " << c.range << " at " << c.distance << " m: " << got << " instead of " << wanted);
        // 1 - (d/r)^4 near 0 keeps the absolute precision of float.
        CHECK(std::abs(got - wanted) <= wanted * (0x1p-10 + 1e-5) + 5e-7);
        if (c.range > 0 && c.distance > c.range) CHECK(got == 0.0);
    }
}

TEMPLATE_LIST_TEST_CASE("spots: full intensity on the axis however narrow, none outside", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = floor_scene();
    const double white = 0.97 / pi, degree = pi / 180;
    for (const double outer : {0.05, 0.25, 0.5, 1.0, 10.0, 45.0, 90.0})
        for (const double inner : {0.0, 0.5, 0.99}) {
            scene.lights = {{.kind = LightKind::spot,
                             .inner_cone = inner * outer * degree,
                             .outer_cone = outer * degree,
                             .position = {0, 1, 0},
                             .direction = {0, -1, 0}}};
            const double got = lit<TestType>(*device, scene, above(3)).x;
            INFO("outer " << outer << " deg, inner " << inner * outer << " deg: " << got / white << " of 1");
            CHECK(stored(got, white));
            // Beyond the edge, seen from straight above that point.
            if (outer >= 80) continue;
            Camera aside = above(3);
            aside.world_from_view[3].x = std::tan((1.02 * outer) * degree);
            CHECK(lit<TestType>(*device, scene, aside).x == 0.0);
            aside.world_from_view[3].x = std::tan((0.9 * outer) * degree);
            CHECK(lit<TestType>(*device, scene, aside).x > 0.0);
        }
}

TEMPLATE_LIST_TEST_CASE("any number of lights, and every one of them counts", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const double white = 0.97 / pi;
    for (const std::uint32_t count : {0u, 1u, 16u, 17u, 256u, 1024u}) {
        Scene scene = floor_scene();
        for (std::uint32_t i = 0; i < count; ++i) {
            // The last one alone is red; spots whose cone is wide are point lights to the middle pixel.
            const bool last = i + 1 == count;
            Light light{.color = last ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), .position = {0, 1, 0}};
            light.kind = i % 3 == 0 ? LightKind::directional : i % 3 == 1 ? LightKind::point : LightKind::spot;
            light.direction = {0, -1, 0};
            light.intensity = last ? 1.0f : 1.0f / 64;
            scene.lights.push_back(light);
        }
        const glm::dvec3 got = lit<TestType>(*device, scene, above(3));
        INFO(count << " lights");
        CHECK(stored(got.x, count > 0 ? white : 0.0));
        CHECK(stored(got.y, count > 0 ? white * (count - 1) / 64 : 0.0, 1e-4));
        CHECK(got.z == 0.0);
    }
}
