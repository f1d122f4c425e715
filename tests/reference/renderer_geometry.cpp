// SPDX-License-Identifier: MIT
// Coverage, clipping, culling and facing of whole scenes, in closed form.
#include <cmath>
#include <numbers>
#include <pellucid/reference/renderer.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;
using reference::Fragment;
using reference::fragments_at;
using reference::Picture;
using reference::render;
using reference::RenderOptions;

namespace {

const Material glass = flat({1, 1, 1, 0.5f}, AlphaMode::blend);
[[nodiscard]] Material double_sided(Material m) {
    m.double_sided = true;
    return m;
}
/// The number of blended fragments of every pixel, and 255 where they differ.
int layers_everywhere(const Picture& p) {
    for (const std::uint32_t n : p.layers.data)
        if (n != p.layers.data[0]) return 255;
    return static_cast<int>(p.layers.data[0]);
}

}  // namespace

TEST_CASE("reference: meshes cover each pixel once, with vertices on centres, mirrored, seen from behind", "[cpu]") {
    // A fan around a pixel centre: 8x8 pixels over [−1, 1]², centres at odd eighths.
    Mesh fan;
    fan.positions.push_back({0.125f, -0.375f, 0});
    for (int i = 0; i < 11; ++i) {
        const double angle = 2 * std::numbers::pi * i / 11;
        fan.positions.push_back({static_cast<float>(5 * std::cos(angle)), static_cast<float>(5 * std::sin(angle)), 0});
        fan.indices.insert(fan.indices.end(),
                           {0, 1 + static_cast<std::uint32_t>(i), 1 + static_cast<std::uint32_t>(i + 1) % 11});
    }
    fan.normals.assign(fan.positions.size(), {0, 0, 1});
    update_bounds(fan);
    // Every second centre is a vertex of a grid.
    Mesh grid;
    for (int y = 0; y <= 8; ++y)
        for (int x = 0; x <= 8; ++x)
            grid.positions.push_back(
                {0.25f * static_cast<float>(x) - 1.125f, 1.125f - 0.25f * static_cast<float>(y), 0});
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const std::uint32_t a = 9 * y + x;
            grid.indices.insert(grid.indices.end(), {a, a + 9, a + 10, a, a + 10, a + 1});
        }
    grid.normals.assign(grid.positions.size(), {0, 0, 1});
    update_bounds(grid);
    // A quarter turn, exactly: (x, y) → (−y, x).
    const glm::dmat4 quarter({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
    struct Case {
        const Mesh* mesh;
        glm::dmat4 world;
        int covered;
    };
    // The grid runs from −1.125 to 0.875 and from 1.125 down to −0.875, and so ends on centres: left and top ends are
    // in, right and bottom ones out.
    const Case cases[] = {{&fan, glm::dmat4(1), 64},     {&fan, scaled(-1, 1, 1), 64},  {&fan, quarter, 64},
                          {&grid, glm::dmat4(1), 49},    {&grid, scaled(-1, 1, 1), 56}, {&grid, quarter, 56},
                          {&grid, scaled(1, -1, 1), 56}, {&grid, scaled(-1, -1, 1), 64}};
    for (const Case& c : cases)
        for (const Projection kind : {Projection::orthographic, Projection::perspective}) {
            Scene scene;
            add(scene, *c.mesh, double_sided(glass), c.world);
            Camera camera = flat_camera();
            camera.projection = kind;
            camera.vertical_fov = 2 * std::atan(0.1);  // the same view of z = 0 from 10 m, up to rounding
            const Picture p = must(render(scene, camera, {.size = {8, 8}}));
            int covered = 0;
            for (const std::uint32_t n : p.layers.data) {
                CHECK(n <= 1);
                covered += n == 1;
            }
            if (kind == Projection::orthographic || c.mesh == &fan)
                CHECK(covered == c.covered);
            else
                CHECK(covered >= 49);  // rounding decides about the ends, not about the inside
        }
    Random random(1);
    // Tilted and moved at random: always once, inside.
    for (int i = 0; i < 20; ++i) {
        Scene scene;
        add(scene, i % 2 ? fan : grid, double_sided(glass),
            glm::rotate(at(0, 0, 0), random.uniform(-0.5, 0.5), random.direction()) * scaled(i % 3 ? 3 : -3, 3, 3));
        CHECK(layers_everywhere(must(
                  render(scene, {.vertical_fov = 0.15, .world_from_view = at(0, 0, 10)}, {.size = {33, 21}}))) == 1);
    }
}

TEST_CASE("reference: a closed shell around the eye covers every pixel once", "[cpu]") {
    Random random(2);
    for (const std::uint32_t subdivisions : {0u, 1u, 4u}) {
        Scene from_inside, solid;
        add(from_inside, make_icosphere(3, subdivisions), double_sided(glass));
        add(solid, make_icosphere(3, subdivisions), glass);  // back faces only: culled
        Scene inside_out;
        add(inside_out, make_icosphere(3, subdivisions), glass, scaled(-1, 1, 1));  // mirrored: still front faces out
        for (int i = 0; i < 12; ++i) {
            Camera camera{.vertical_fov = random.uniform(0.2, 3), .near = 0.01};
            camera.world_from_view = look_at(random.direction() * 0.9, random.direction(), random.direction());
            const RenderOptions options{.size = {37, 29}};
            CHECK(layers_everywhere(must(render(from_inside, camera, options))) == 1);
            CHECK(layers_everywhere(must(render(solid, camera, options))) == 0);
            CHECK(layers_everywhere(must(render(inside_out, camera, options))) == 0);
        }
        // The eye in a vertex, and in an edge, of the shell's own rays: looking straight at them.
        for (const glm::vec3& vertex : make_icosphere(3, subdivisions).positions) {
            const glm::dvec3 up = std::abs(vertex.y) > 2 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
            const Camera camera{.world_from_view = look_at({0, 0, 0}, glm::dvec3(vertex), up)};
            REQUIRE(layers_everywhere(must(render(from_inside, camera, {.size = {9, 9}}))) == 1);
            if (subdivisions == 4 && vertex.x > -2.9) break;
        }
        // Parallel rays that start inside meet the far half, and those that start in front of it meet both.
        Camera flat = flat_camera();
        flat.near = 10;
        CHECK(layers_everywhere(must(render(from_inside, flat, {.size = {16, 16}}))) == 1);
        flat.near = 1;
        CHECK(layers_everywhere(must(render(from_inside, flat, {.size = {16, 16}}))) == 2);
        CHECK(layers_everywhere(must(render(solid, flat, {.size = {16, 16}}))) == 1);
        flat.far = 10;  // the near half alone
        CHECK(layers_everywhere(must(render(from_inside, flat, {.size = {16, 16}}))) == 1);
    }
}

TEST_CASE("reference: a ground that goes through the near plane and behind the eye", "[cpu]") {
    // y = −1 under an eye at the origin that looks along −z; row r looks down by (r + 0.5 − 16)/16 tan(fov/2).
    const double half = std::tan(0.5 * 1.2);
    for (const double near : {1e-3, 2.0, 5.0}) {
        Scene scene;
        add(scene, make_plane(2000, 2000), flat({1, 1, 1, 1}), at(0, -1, 0));
        const Camera camera{.vertical_fov = 1.2, .near = near};
        const Picture p = must(render(scene, camera, {.size = {24, 32}}));
        for (std::uint32_t y = 0; y < 32; ++y) {
            const double down = (y + 0.5 - 16) / 16 * half, distance = 1 / down;
            for (std::uint32_t x = 0; x < 24; ++x) {
                CAPTURE(near, x, y);
                CHECK(p.radiance.texel(x, y)[0] == (down > 0 && distance >= near ? 1.0f : 0.0f));
            }
            if (down <= 0 || distance < near) continue;
            const std::vector<Fragment> f = must(fragments_at(scene, camera, {.size = {24, 32}}, 5, y));
            REQUIRE(f.size() == 1);
            CHECK(f[0].depth == Approx(near / distance).epsilon(1e-12));
        }
    }
}

TEST_CASE("reference: faces are culled, mirrored instances the other way round", "[cpu]") {
    const Material red = flat({1, 0, 0, 1});
    const auto seen = [&](const Material& m, const glm::dmat4& world) {
        Scene scene;
        add(scene, quad(), m, world);
        return must(render(scene, flat_camera(), {.size = {8, 8}})).radiance.texel(2, 5)[0] == 1.0f;
    };
    const glm::dmat4 away = glm::rotate(glm::dmat4(1), std::numbers::pi, glm::dvec3(0, 1, 0));
    CHECK(seen(red, glm::dmat4(1)));
    CHECK_FALSE(seen(red, away));
    CHECK(seen(red, scaled(-1, 1, 1)));  // mirrored along the surface: its front still faces the eye
    CHECK(seen(red, scaled(-1, -2, 1)));
    CHECK_FALSE(seen(red, scaled(1, 1, -1)));  // mirrored across it: the front faces away
    CHECK(seen(red, away * scaled(1, 1, -1)));
    for (const glm::dmat4& world : {glm::dmat4(1), away, scaled(1, 1, -1), scaled(-1, 1, 1)})
        CHECK(seen(double_sided(red), world));
    CHECK_FALSE(seen(double_sided(red),
                     glm::rotate(glm::dmat4(1), std::numbers::pi / 2, glm::dvec3(0, 1, 0)) * scaled(1, 1, 0)));
}

TEST_CASE("reference: a double-sided surface is lit on the side that is seen", "[cpu]") {
    // A light at the eye's side lights either face alike; one behind the surface lights neither.
    const Material white = double_sided(matte({1, 1, 1}));
    const glm::dmat4 away = glm::rotate(glm::dmat4(1), std::numbers::pi, glm::dvec3(0, 1, 0));
    for (const glm::dmat4& world : {glm::dmat4(1), away, scaled(1, 1, -1), scaled(-1, 1, 1), away * scaled(-1, 1, 1)})
        for (const double from : {1.0, -1.0}) {
            Scene scene;
            add(scene, quad(), white, world);
            RenderOptions options{.size = {8, 8}};
            options.lights = {{.kind = LightKind::directional, .intensity = 3, .direction = {0, 0, -from}}};
            const float radiance = must(render(scene, flat_camera(), options)).radiance.texel(3, 3)[0];
            // Dielectric, roughness 1, everything on the axis: (1 − F0)/π + F0/(4π), times 3 lx.
            CHECK(radiance == Approx(from > 0 ? 3 * (0.96 + 0.04 / 4) / std::numbers::pi : 0.0).epsilon(1e-6));
        }
}

TEST_CASE("reference: where the scene is makes no difference", "[cpu]") {
    // The same view at the origin and 1e6 m away: positions in double leave 1e-10 m.
    Scene scene = varied_scene();
    const Camera camera = varied_camera();
    RenderOptions options{.size = {40, 30}, .lights = scene.lights};
    const Picture here = must(render(scene, camera, options));
    const glm::dvec3 far(1048576, -524288, 2097152);
    Camera moved_camera = camera;
    moved_camera.world_from_view[3] += glm::dvec4(far, 0);
    for (Instance& instance : scene.instances) instance.world_from_object[3] += glm::dvec4(far, 0);
    for (Light& light : options.lights) light.position += far;
    const Picture there = must(render(scene, moved_camera, options));
    double worst = 0;
    for (std::size_t i = 0; i < here.radiance.data.size(); ++i)
        worst = std::max<double>(
            worst, std::abs(here.radiance.data[i] - there.radiance.data[i]) / std::max(1.0f, here.radiance.data[i]));
    CHECK(worst < 1e-6);
}

TEST_CASE("reference: degenerate and empty meshes are nothing, and many small instances are all there", "[cpu]") {
    Scene scene;
    Mesh nothing = quad();
    nothing.indices.clear();
    add(scene, nothing, glass);
    Mesh points = quad();
    points.indices = {0, 0, 0, 1, 1, 2, 0, 2, 2};
    add(scene, points, double_sided(glass));
    add(scene, quad(), glass, scaled(0, 0, 0));
    CHECK(layers_everywhere(must(render(scene, flat_camera(), {.size = {16, 16}, .stability = true}))) == 0);
    // 16x16 quads, each a little larger than a pixel centre, over 16x16 pixels.
    const auto mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(quad());
    scene.meshes.back().material = 0;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            scene.instances.push_back({mesh, at((x - 7.5) / 8, (7.5 - y) / 8, 0) * scaled(1e-3, 1e-3, 1)});
    CHECK(layers_everywhere(must(render(scene, flat_camera(), {.size = {16, 16}}))) == 1);
}
