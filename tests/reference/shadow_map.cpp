// SPDX-License-Identifier: MIT
// The filter of shadow maps in double against its closed form; exact hard shadows by rays against geometry.
#include <pellucid/reference/renderer.hpp>
#include <pellucid/reference/shadow_map.hpp>
#include "support/catch.hpp"
#include "support/shadow_cases.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using test::add;

namespace {

/// A map of 32 texels of 1 m, from 100 m above the ground, whose texels up to `column` (or row) hold something 50 m up.
std::vector<float> edge_map(std::uint32_t column, bool along_x) {
    std::vector<float> depths(32 * 32, 0.01f);
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x)
            if ((along_x ? x : y) < column) depths[32 * y + x] = 0.5f;
    return depths;
}
Camera above() {
    return {.projection = Projection::orthographic,
            .half_width = 16,
            .half_height = 16,
            .near = 0,
            .far = 101,
            .world_from_view = look_at({0, 100, 0}, {0, 0, 0}, {0, 0, -1})};
}

}  // namespace

TEST_CASE("the filter at a straight edge is its closed form at 64 places in a texel", "[cpu]") {
    for (const bool along_x : {true, false}) {
        const std::vector<float> depths = edge_map(16, along_x);
        const ShadowMapView map{above(), 32, depths};
        for (int i = -3 * 64; i <= 3 * 64; ++i) {
            const double t = i / 64.0;  // [m], [texel] from the edge
            for (const double other : {0.0, 0.3, -2.71}) {
                const auto light =
                    filtered_light(map, along_x ? glm::dvec3(t, 0, other) : glm::dvec3(other, 0, t), {0, 1, 0});
                REQUIRE(light);
                CHECK(*light == Approx(edge_light(t)).margin(1e-12));
            }
        }
    }
    CHECK(edge_light(0) == 0.5);
    CHECK(edge_light(-1.5) == 0);
    CHECK(edge_light(1.5) == 1);
}

TEST_CASE("a tilted plane does not shadow itself in the filter, from any place and at any slope", "[cpu]") {
    for (int degrees = 0; degrees < 90; ++degrees)
        for (const double turn : {0.0, 0.7, 2.1}) {
            const double a = glm::radians(static_cast<double>(degrees));
            const glm::dvec3 n(std::sin(a) * std::cos(turn), std::cos(a), std::sin(a) * std::sin(turn));
            // What such a plane leaves in the map: reversed depth of 101 m.
            std::vector<float> depths;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const double px = x + 0.5 - 16, pz = y + 0.5 - 16, height = -(n.x * px + n.z * pz) / n.y;
                    depths.push_back(static_cast<float>((1 + height) / 101));
                }
            for (int i = 0; i < 50; ++i) {
                const double px = 3.0 * std::sin(i * 1.7), pz = 3.0 * std::cos(i * 2.3);
                const glm::dvec3 p(px, -(n.x * px + n.z * pz) / n.y, pz);
                const auto light = filtered_light({above(), 32, depths}, p, n);
                INFO(degrees << " degrees, turned by " << turn);
                REQUIRE(light);
                CHECK(*light == Approx(1).margin(1e-12));
            }
        }
}

TEST_CASE("there is no answer where the filter would read beyond the map", "[cpu]") {
    const std::vector<float> depths = edge_map(0, true);
    const ShadowMapView map{above(), 32, depths};
    const auto known = [&](double x) { return filtered_light(map, {x, 0, 0}, {0, 1, 0}).has_value(); };
    CHECK(known(14.4));
    CHECK_FALSE(known(14.6));
    CHECK(known(-14.4));
    CHECK_FALSE(known(-14.6));
    Camera spot{.vertical_fov = 1, .near = 0.1, .world_from_view = above().world_from_view};
    CHECK_FALSE(filtered_light({spot, 32, depths}, {0, 101, 0}, {0, 1, 0}));  // behind the light
    CHECK(filtered_light({spot, 32, depths}, {0, 0, 0}, {0, 1, 0}));
}

TEST_CASE("rays: hard shadows are where geometry says, for every kind of light", "[cpu]") {
    Scene scene;
    test::add_floor(scene, 3);
    test::add_sheet(scene, {0, 1, 0}, 0.5f);
    const Camera camera = test::plan_camera({0, 0, 0}, 2.5);
    struct Case {
        Light light;
        glm::dvec2 middle;
        double half;
    };
    // A sheet of half side 0.5 at half the height of a light throws a shadow of half side 1.
    for (const Case& c : {Case{test::sun({1.2, -1, 0.9}), {1.2, 0.9}, 0.5}, Case{test::bulb({0.8, 2, 0}), {-0.8, 0}, 1},
                          Case{test::torch({0, 2, -0.8}, {0, 0, 0.8}, 1.0), {0, 0.8}, 1}}) {
        scene.lights = {c.light};
        RenderOptions options{.size = {101, 101}, .lights = scene.lights, .shadows = true};
        const Picture with = test::must(render(scene, camera, options));
        options.shadows = false;
        const Picture without = test::must(render(scene, camera, options));
        std::size_t dark = 0;
        for (std::uint32_t y = 0; y < 101; ++y)
            for (std::uint32_t x = 0; x < 101; ++x) {
                const glm::dvec3 p = test::plan_point({0, 0, 0}, 2.5, 101, x, y);
                if (std::max(std::abs(p.x), std::abs(p.z)) < 0.55) continue;  // the sheet
                const double off = std::max(std::abs(p.x - c.middle.x), std::abs(p.z - c.middle.y));
                if (std::abs(off - c.half) < 1e-6) continue;
                const bool shadow = off < c.half;
                dark += shadow;
                CHECK(with.radiance.texel(x, y)[0] == (shadow ? 0 : without.radiance.texel(x, y)[0]));
            }
        CHECK(dark > 100);
        scene.lights[0].shadows = false;
        options = {.size = {101, 101}, .lights = scene.lights, .shadows = true};
        CHECK(test::must(render(scene, camera, options)).radiance.data == without.radiance.data);
    }
}

TEST_CASE("rays: no ray slips into a closed surface through an edge or a corner, or is stopped by its own", "[cpu]") {
    Scene scene;
    test::add_floor(scene, 4);
    add(scene, make_icosphere(1, 4), test::matte({0.5f, 0.5f, 0.5f}), test::at(0, 1.5, 0));
    // The floor's pixels are seen from below the ball: all those that the ball hides are dark, whatever edge a ray
    // meets.
    scene.lights = {test::sun({0, -1, 0})};
    const Camera camera{.projection = Projection::orthographic,
                        .half_width = 2,
                        .half_height = 2,
                        .near = 0.01,
                        .far = 0.5,
                        .world_from_view = look_at({0, 0.3, 0}, {0, 0, 0}, {0, 0, -1})};
    const Picture picture =
        test::must(render(scene, camera, {.size = {256, 256}, .lights = scene.lights, .shadows = true}));
    std::size_t dark = 0, lit = 0;
    for (std::uint32_t y = 0; y < 256; ++y)
        for (std::uint32_t x = 0; x < 256; ++x) {
            const glm::dvec3 p = test::plan_point({0, 0, 0}, 2, 256, x, y);
            const double r = glm::length(p);
            if (r > 0.99 && r < 1.01) continue;  // the ball is made of facets
            const bool black = picture.radiance.texel(x, y)[0] == 0;
            CHECK(black == (r < 1));
            (black ? dark : lit) += 1;
        }
    CHECK(dark > 10000);
    CHECK(lit > 10000);
}

TEST_CASE("rays: single-sided surfaces cast from their front, masked ones where they are, blended ones nowhere",
          "[cpu]") {
    const auto share_of_dark = [](Material material, double turn, double mirror = 1) {
        Scene scene;
        test::add_floor(scene, 3);
        scene.images.push_back({Image8(2, 2, 4), "half"});
        scene.images[0].pixels.data = {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0};
        scene.textures.push_back(
            {.image = 0,
             .sampler = {.min = TextureFilter::nearest, .mag = TextureFilter::nearest, .mipmapped = false}});
        if (material.alpha_mode == AlphaMode::mask) material.base_color_texture.texture = 0;
        add(scene, test::quad(0.5f, 0.5f), material,
            test::at(0, 1, 0) * glm::rotate(glm::dmat4(1), turn * 0.5 * glm::pi<double>(), glm::dvec3(1, 0, 0)) *
                test::scaled(mirror, 1, 1));
        const Light light = test::sun({1.2, -1, 0});
        const Picture p = test::must(
            render(scene, test::plan_camera({1.2, 0, 0}, 0.5), {.size = {32, 32}, .lights = {light}, .shadows = true}));
        std::size_t dark = 0;
        for (std::size_t i = 0; i < p.radiance.data.size(); i += 3) dark += p.radiance.data[i] == 0;
        return static_cast<double>(dark) / (32 * 32);
    };
    Material sheet = test::matte({0.5f, 0.5f, 0.5f});
    CHECK(share_of_dark(sheet, -1) == 1);
    CHECK(share_of_dark(sheet, -1, -1) == 1);  // mirrored: its front is still above
    CHECK(share_of_dark(sheet, 1) == 0);
    sheet.double_sided = true;
    CHECK(share_of_dark(sheet, 1) == 1);
    sheet.alpha_mode = AlphaMode::mask;
    CHECK(share_of_dark(sheet, -1) == Approx(0.5).margin(0.04));
    sheet.alpha_mode = AlphaMode::blend;
    CHECK(share_of_dark(sheet, -1) == 0);
}
