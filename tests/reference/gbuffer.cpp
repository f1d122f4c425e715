// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/reference/gbuffer.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::degrees_between;
using pellucid::test::Random;

namespace {

/// Axes, octants and points on and beside the folds x = 0, y = 0, z = 0, with zeros of both signs.
std::vector<glm::dvec3> hard_directions() {
    std::vector<glm::dvec3> list;
    const double values[] = {0.0, -0.0, 1e-300, -1e-300, 1e-9, -1e-9, 1e-4, -1e-4, 0.3, -0.3, 1, -1};
    for (const double x : values)
        for (const double y : values)
            for (const double z : values)
                if (const glm::dvec3 d(x, y, z); glm::length(d) > 1e-10) list.push_back(glm::normalize(d));
    return list;
}

/// Largest relative errors |Δp|/|p| of positions that went through float depth.
struct PositionError {
    double view = 0;   ///< vertices in view space, from double: float depth and back
    double world = 0;  ///< camera-relative vertices: rotated into view space and back by float as well
};

PositionError worst_position_error(double far_over_near, double camera_offset, int count) {
    Random random(5);
    const Extent2D size{1920, 1080};
    PositionError worst;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 eye = random.direction() * camera_offset;
        const Camera camera{.world_from_view = look_at(eye, eye + random.direction())};
        const ClipFromView exact = clip_from_view(camera, size);
        const ClipCoefficients<float> clip(exact);
        const auto x = static_cast<std::uint32_t>(random.uniform(0, size.width));
        const auto y = static_cast<std::uint32_t>(random.uniform(0, size.height));
        // A world point on the pixel's ray, as the scene's double coordinates hold it.
        const double distance = camera.near * std::exp(random.uniform(0, std::log(far_over_near)));
        const glm::dvec2 ndc = ndc_from_pixel<double>(x, y, size);
        const glm::dvec3 on_ray(ndc.x * distance / exact.sx, ndc.y * distance / exact.sy, -distance);
        const glm::dvec3 world = eye + relative_from_view(camera, on_ray);
        const glm::dvec3 relative = world - eye;  // in double, as the renderer does
        const glm::dmat4& m = camera.world_from_view;
        const auto rotated = [&]<class V>(V p) {
            return V(glm::dot(V(m[0]), p), glm::dot(V(m[1]), p), glm::dot(V(m[2]), p));
        };
        const auto through_depth = [&](glm::vec3 view) {
            return view_from_depth(clip, ndc_from_pixel<float>(x, y, size), depth_from_view(clip, view));
        };
        const glm::dvec3 in_view = rotated(relative);
        const glm::dvec3 back(through_depth(glm::vec3(in_view)));
        worst.view = std::max(worst.view, glm::length(back - in_view) / glm::length(in_view));
        const glm::dvec3 found(relative_from_view(camera, through_depth(rotated(glm::vec3(relative)))));
        worst.world = std::max(worst.world, glm::length(found - relative) / glm::length(relative));
    }
    return worst;
}

}  // namespace

TEST_CASE("oct32 normals are within 0.0025 degrees", "[cpu]") {
    Random random(2);
    double worst = 0, sum = 0;
    const int count = 300000;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 d = random.direction();
        const double error = degrees_between(direction_from_oct32<double>(oct32_from_direction(d)), d);
        worst = std::max(worst, error);
        sum += error;
    }
    CHECK(worst <= 0.0025);
    CHECK(sum / count <= 0.00125);
    for (const glm::dvec3& d : hard_directions())
        REQUIRE(degrees_between(direction_from_oct32<double>(oct32_from_direction(d)), d) <= 0.0025);
}

TEST_CASE("oct32 normals stay within 0.0025 degrees in float arithmetic", "[cpu]") {
    Random random(4);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec3 d = random.direction();
        const glm::vec3 decoded = direction_from_oct32<float>(oct32_from_direction(glm::vec3(d)));
        worst = std::max(worst, degrees_between(glm::dvec3(decoded), d));
    }
    CHECK(worst <= 0.0025);
    for (const glm::dvec3& d : hard_directions())
        REQUIRE(degrees_between(glm::dvec3(direction_from_oct32<float>(oct32_from_direction(glm::vec3(d)))), d) <=
                0.0025);
}

TEST_CASE("the six axes are stored exactly, whatever the signs of their zeros", "[cpu]") {
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f})
            for (const float zero : {0.0f, -0.0f}) {
                glm::vec3 d(zero);
                d[axis] = sign;
                REQUIRE(direction_from_oct32<float>(oct32_from_direction(d)) == d);
                REQUIRE(direction_from_oct32<double>(oct32_from_direction(glm::dvec3(d))) == glm::dvec3(d));
            }
}

TEST_CASE("octahedral codes: known values, the fold, and what has no direction", "[cpu]") {
    CHECK(oct32_from_direction(glm::dvec3(0, 0, 1)) == 0u);
    CHECK(oct32_from_direction(glm::dvec3(1, 0, 0)) == 0x00007FFFu);
    CHECK(oct32_from_direction(glm::dvec3(0, -1, 0)) == 0x80010000u);
    CHECK(octahedron_from_direction(glm::dvec3(0, 0, -1)) == glm::dvec2(1, 1));
    CHECK(octahedron_from_direction(glm::dvec3(-0.0, -0.0, -1)) == glm::dvec2(1, 1));
    CHECK(octahedron_from_direction(glm::dvec3(-0.5, 0.25, -0.25)) == glm::dvec2(-0.75, 0.5));
    CHECK(direction_from_oct32<double>(0x00008000u) == glm::dvec3(-1, 0, 0));  // −32768 is −1
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(oct32_from_direction(glm::vec3(0.0f)) == 0u);
    CHECK(oct32_from_direction(glm::vec3(nan, 0, 1)) == 0u);
    CHECK(oct32_from_direction(glm::vec3(std::numeric_limits<float>::infinity(), 0, 1)) == 0u);
}

TEST_CASE("precise rounding beats rounding to nearest", "[cpu]") {
    Random random(9);
    double precise = 0, nearest = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 d = random.direction();
        const glm::dvec2 p = octahedron_from_direction(d) * 32767.0;
        const auto code = [](double v) {
            return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(v))) & 0xFFFFu;
        };
        nearest = std::max(nearest, degrees_between(direction_from_oct32<double>(code(p.x) | code(p.y) << 16u), d));
        precise = std::max(precise, degrees_between(direction_from_oct32<double>(oct32_from_direction(d)), d));
    }
    CHECK(precise < 0.75 * nearest);
}

TEST_CASE("the compact layout keeps what it can hold", "[cpu]") {
    CHECK(pack_material(1.0, 0.0, 0) == 0x0000FFFFu);
    CHECK(pack_material(0.0, 1.0, 0) == 0x00FF0000u);
    CHECK(pack_material(0.5, 0.5, 0xA5) == 0xA5808000u);
    CHECK(pack_material(-1.0f, 2.0f, 1) == 0x01FF0000u);
    CHECK(pack_material(std::numeric_limits<double>::quiet_NaN(), 0.0, 0) == 0u);
    CHECK(material_flags(0xA5808000u) == 0xA5);
    const Surface<double> surface{.normal = glm::normalize(glm::dvec3(1, -2, 0.5)),
                                  .base_color = {linear_from_srgb8(1), linear_from_srgb8(128), linear_from_srgb8(255)},
                                  .metallic = 77 / 255.0,
                                  .roughness = 0.12345,
                                  .occlusion = 200 / 255.0};
    const CompactTexel texel = pack_surface(surface, 3, 0.25f);
    CHECK(texel.color == 0xC8FF8001u);
    CHECK(texel.depth == 0.25f);
    const Surface<double> back = unpack_surface<double>(texel);
    CHECK(degrees_between(back.normal, surface.normal) < 0.0025);
    CHECK(back.base_color == surface.base_color);
    CHECK(back.metallic == Approx(surface.metallic).epsilon(1e-14));
    CHECK(back.occlusion == Approx(surface.occlusion).epsilon(1e-14));
    CHECK(std::abs(back.roughness - surface.roughness) <= 0.5 / 65535 + 1e-12);
    CHECK(pack_surface(back, 3, 0.25f) == texel);  // unpacking and packing again changes nothing
}

TEST_CASE("16 bits of roughness hold the peak of D to 0.2 percent, and are monotone", "[cpu]") {
    double last = -1, worst = 0;
    for (int i = 0; i <= 20000; ++i) {
        const double roughness = 0.02 + 0.18 * i / 20000;
        const double stored = (pack_material(roughness, 0.0, 0) & 0xFFFFu) / 65535.0;
        REQUIRE(stored >= last);
        last = stored;
        worst = std::max(worst, std::abs(std::pow(roughness / stored, 4) - 1));
    }
    CHECK(worst < 2e-3);
}

TEST_CASE("positions come back from float depth to 2.5e-7, for any far/near and any camera offset", "[cpu]") {
    for (const double far_over_near : {1e3, 1e4, 1e5, 1e6})
        for (const double offset : {0.0, 10.0, 1e3, 1e5}) {
            CAPTURE(far_over_near, offset);
            const PositionError worst = worst_position_error(far_over_near, offset, 20000);
            CHECK(worst.view <= 2.5e-7);
            CHECK(worst.world <= 4e-7);
        }
}

TEST_CASE("depth and position invert each other for both projections", "[cpu]") {
    const Extent2D size{640, 480};
    Camera camera{.near = 0.25, .far = 40};
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        camera.projection = projection;
        const ClipCoefficients<double> clip(clip_from_view(camera, size));
        CHECK(depth_from_view(clip, glm::dvec3(0, 0, -camera.near)) == Approx(1).epsilon(1e-14));
        for (const double z : {-0.25, -1.0, -39.0}) {
            const glm::dvec3 e(0.3, -0.2, z);
            const double w = e.z * clip.wz + clip.ww;
            const glm::dvec2 ndc((e.x * clip.sx + clip.ox) / w, (e.y * clip.sy + clip.oy) / w);
            CHECK(glm::length(view_from_depth(clip, ndc, depth_from_view(clip, e)) - e) < 1e-12);
        }
    }
    const ClipCoefficients<double> clip(clip_from_view(camera, size));
    CHECK(depth_from_view(clip, glm::dvec3(0, 0, -camera.far)) == Approx(0).margin(1e-15));
    CHECK(ndc_from_pixel<double>(0, 0, size) == glm::dvec2(1.0 / 640 - 1, 1 - 1.0 / 480));
    CHECK(ndc_from_pixel<double>(639, 479, size).y == Approx(-1 + 1.0 / 480).epsilon(1e-14));
}
