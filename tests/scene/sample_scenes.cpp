// SPDX-License-Identifier: MIT
/// \file
/// The library's own scenes are valid, come back from a file, and are as hard as they claim.
#include <pellucid/reference/gbuffer.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <glm/geometric.hpp>
#include <set>
#include "scene/mesh_checks.hpp"
#include "scene/same_scene.hpp"
#include "scene/view_layers.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

const Material& material_of(const Scene& scene, std::size_t instance) {
    return scene.materials[scene.meshes[scene.instances[instance].mesh].material];
}
bool translucent(const Scene& scene, std::size_t instance) {
    return material_of(scene, instance).alpha_mode == AlphaMode::blend;
}

/// Every index, mesh and unit vector; one rigid camera; translucent surfaces that blend, and are seen from both sides.
void check_valid(const Scene& scene) {
    REQUIRE(scene.cameras.size() == 1);
    const glm::dmat3 turned(scene.cameras[0].world_from_view);
    for (int c = 0; c < 3; ++c) CHECK(glm::length(glm::transpose(turned)[c]) == Approx(1));
    CHECK(glm::determinant(turned) == Approx(1));
    std::set<std::uint32_t> used;
    for (const Instance& instance : scene.instances) {
        REQUIRE(instance.mesh < scene.meshes.size());
        used.insert(instance.mesh);
    }
    CHECK(used.size() == scene.meshes.size());
    for (const Mesh& mesh : scene.meshes) {
        INFO(mesh.name);
        REQUIRE(mesh.material < scene.materials.size());
        test::check_valid(mesh);
    }
    for (const Material& material : scene.materials) {
        INFO(material.name);
        for (int c = 0; c < 4; ++c) CHECK((material.base_color[c] >= 0 && material.base_color[c] <= 1));
        if (material.alpha_mode == AlphaMode::blend) CHECK((material.double_sided && material.base_color.w < 1));
    }
    for (const Light& light : scene.lights) CHECK(glm::length(light.direction) == Approx(1));
}

/// Valid, the same when made again, and the same after it was a file.
void check_scene(Scene (*make)()) {
    const Scene scene = make();
    check_valid(scene);
    check_same(scene, make());
    check_same(scene, round_trip(scene));
}

std::size_t most_layers(const std::vector<std::vector<Layer>>& pixels) {
    std::size_t most = 0;
    for (const std::vector<Layer>& layers : pixels) most = std::max(most, layers.size());
    return most;
}
/// No pixel of the picture's border shows anything.
bool inside_picture(const std::vector<std::vector<Layer>>& pixels, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
        for (const std::size_t border : {i, (size - 1) * size + i, i * size, i * size + size - 1})
            if (!pixels[border].empty()) return false;
    return true;
}

}  // namespace

TEST_CASE("peeling: teapot, pane and sphere have no order", "[cpu][sample_scenes]") {
    check_scene(make_peeling_scene);
    const Scene scene = make_peeling_scene();
    REQUIRE(scene.instances.size() == 3);
    const auto pixels = view_layers(scene, 128);
    for (std::size_t a = 0; a < 3; ++a) {
        CHECK(translucent(scene, a));
        CHECK((material_of(scene, a).base_color.w >= 0.4f && material_of(scene, a).base_color.w <= 0.6f));
        for (std::size_t b = 0; b < 3; ++b)
            if (a != b) CHECK(pixels_before(pixels, a, b) > 100);
    }
    CHECK(most_layers(pixels) >= 6);
    CHECK(inside_picture(pixels, 128));
}

TEST_CASE("linked chain: neighbours are linked, nothing touches", "[cpu][sample_scenes]") {
    check_scene([] { return make_linked_chain(); });
    constexpr double major = 1, minor = 0.15, pi = 3.14159265358979323846;
    for (const std::uint32_t links : {6u, 7u, 8u, 9u, 12u, 25u, 64u}) {
        INFO(links);
        const Scene scene = make_linked_chain(links);
        REQUIRE(scene.instances.size() == links);
        const auto column = [&](std::size_t i, int c) { return glm::dvec3(scene.instances[i].world_from_object[c]); };
        const auto core = [&](std::size_t i, double angle) {
            return column(i, 3) + major * (std::cos(angle) * column(i, 0) + std::sin(angle) * column(i, 2));
        };
        for (std::size_t i = 0; i < links; ++i) {
            const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
            CHECK((mesh.upper.x == Approx(major + minor) && mesh.upper.y == Approx(minor)));
            CHECK(glm::dot(column(i, 1), glm::cross(column(i, 2), column(i, 0))) == Approx(1));
            for (std::size_t j = 0; j < links; ++j) {
                if (j == i) continue;
                // The core of j crosses the plane of i; it is linked with i if it does so once inside the core of i.
                int inside = 0;
                double nearest = 100;
                constexpr int steps = 720;
                for (int k = 0; k < steps; ++k) {
                    const glm::dvec3 here = core(j, 2 * pi * k / steps) - column(i, 3);
                    const glm::dvec3 next = core(j, 2 * pi * (k + 1) / steps) - column(i, 3);
                    const double h0 = glm::dot(here, column(i, 1)), h1 = glm::dot(next, column(i, 1));
                    const glm::dvec3 flat = here - h0 * column(i, 1);
                    nearest = std::min(nearest, std::hypot(glm::length(flat) - major, h0));
                    if ((h0 < 0) != (h1 < 0) && glm::length(glm::mix(here, next, h0 / (h0 - h1))) < major) ++inside;
                }
                const bool neighbours = (i + 1) % links == j || (j + 1) % links == i;
                CHECK(inside % 2 == (neighbours ? 1 : 0));
                CHECK(nearest > 2 * minor + pi * major / steps);  // the samples' own distance
            }
        }
    }
    const Scene scene = make_linked_chain();
    const auto pixels = view_layers(scene, 128);
    CHECK(inside_picture(pixels, 128));
    for (std::size_t i = 0; i < 8; ++i) {
        INFO(i);
        CHECK((translucent(scene, i) && material_of(scene, i).unlit));
        CHECK(pixels_before(pixels, i, (i + 1) % 8) > 10);
        CHECK(pixels_before(pixels, (i + 1) % 8, i) > 10);
    }
}

TEST_CASE("intersecting planes: all orders, crossing in a cube", "[cpu][sample_scenes]") {
    check_scene([] { return make_intersecting_planes(); });
    const Scene scene = make_intersecting_planes(0.25f);
    REQUIRE(scene.instances.size() == 4);
    CHECK_FALSE(translucent(scene, 0));
    CHECK(closed(scene.meshes[scene.instances[0].mesh]));
    std::set<std::vector<std::size_t>> orders;
    const auto pixels = view_layers(scene, 128);
    CHECK(inside_picture(pixels, 128));
    for (const std::vector<Layer>& layers : pixels) {
        std::vector<std::size_t> order;
        for (const Layer& layer : layers)
            if (layer.instance != 0) order.push_back(layer.instance);
        if (order.size() == 3) orders.insert(order);
    }
    for (std::size_t a = 1; a < 4; ++a) {
        CHECK(material_of(scene, a).base_color.w == 0.25f);
        const glm::dmat4& pane = scene.instances[a].world_from_object;
        const glm::dmat4& next = scene.instances[a % 3 + 1].world_from_object;
        CHECK(std::abs(glm::dot(pane[2], next[2])) < 1e-12);
        CHECK(glm::dvec3(pane[3]) == glm::dvec3(0));  // the middle of the cube
        CHECK(pixels_before(pixels, a, a % 3 + 1) > 100);
        CHECK(pixels_before(pixels, a % 3 + 1, a) > 100);
    }
    // The lines in which two of the three cross part the picture into six sectors, each with another order.
    CHECK(orders.size() == 6);
}

TEST_CASE("random quads: exact colours, many crossings", "[cpu][sample_scenes]") {
    check_scene([] { return make_random_quads(); });
    const Scene scene = make_random_quads(64, 7);
    check_valid(scene);
    REQUIRE(scene.instances.size() == 65);
    CHECK_FALSE(translucent(scene, 0));
    std::size_t crossing = 0;
    for (std::size_t i = 1; i < 65; ++i) {
        const Material& material = material_of(scene, i);
        CHECK((material.unlit && material.alpha_mode == AlphaMode::blend));
        for (int c = 0; c < 4; ++c) {
            const double code = std::round(double{material.base_color[c]} * 255);
            CHECK(material.base_color[c] == static_cast<float>(code / 255));
            if (c == 3) CHECK((code >= 51 && code <= 204));
        }
        // Edges of the one that pass through the other.
        bool crosses = false;
        for (std::size_t j = 1; j < 65 && !crosses; ++j) {
            if (j == i) continue;
            const glm::dmat4 other_from_this =
                glm::inverse(scene.instances[j].world_from_object) * scene.instances[i].world_from_object;
            const Mesh &mesh = scene.meshes[scene.instances[i].mesh], &other = scene.meshes[scene.instances[j].mesh];
            for (std::size_t corner = 0; corner < 4; ++corner) {
                const glm::dvec4 a = other_from_this * glm::dvec4(glm::dvec3(mesh.positions[corner]), 1);
                const glm::dvec4 b = other_from_this * glm::dvec4(glm::dvec3(mesh.positions[(corner + 1) % 4]), 1);
                if ((a.z < 0) == (b.z < 0)) continue;
                const glm::dvec4 p = glm::mix(a, b, a.z / (a.z - b.z));
                crosses = crosses || (std::abs(p.x) < other.upper.x && std::abs(p.y) < other.upper.y);
            }
        }
        crossing += crosses ? 1 : 0;
    }
    CHECK(crossing > 32);
    CHECK(most_layers(view_layers(scene, 128)) > 6);
    CHECK(make_random_quads(0).instances.size() == 1);
    CHECK(make_random_quads(1000).instances.size() == 1001);
    CHECK(make_random_quads(64, 8).materials[1].base_color != scene.materials[1].base_color);
    // FNV-1a of the colours' codes: the numbers are the same on every machine.
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const Material& material : make_random_quads(64, 1).materials)
        for (int c = 0; c < 4; ++c)
            hash = (hash ^ static_cast<std::uint64_t>(std::lround(material.base_color[c] * 255))) * 0x100000001B3u;
    CHECK(hash == 0xA7F74228B56A8AC8u);
}

TEST_CASE("cyclic triangles: each is in front of the next", "[cpu][sample_scenes]") {
    check_scene(make_cyclic_triangles);
    const Scene scene = make_cyclic_triangles();
    REQUIRE(scene.instances.size() == 3);
    const auto pixels = view_layers(scene, 256);
    CHECK(inside_picture(pixels, 256));
    CHECK(most_layers(pixels) == 2);
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        const std::size_t one = pixels_before(pixels, a, b), other = pixels_before(pixels, b, a);
        CHECK(one + other > 500);
        CHECK(one * other == 0);
        CHECK((one > 0) == (pixels_before(pixels, 0, 1) > 0));  // the same way round
    }
}

TEST_CASE("lit glass: three kinds of light, glass in glass", "[cpu][sample_scenes]") {
    check_scene([] { return make_lit_glass(); });
    for (const std::uint32_t seed : {1u, 2u, 3u, 99u}) {
        INFO(seed);
        const Scene scene = make_lit_glass(seed);
        check_valid(scene);
        REQUIRE(scene.lights.size() == 3);
        std::set<LightKind> kinds;
        for (const Light& light : scene.lights) kinds.insert(light.kind);
        CHECK(kinds.size() == 3);
        REQUIRE(scene.instances.size() == 6);
        CHECK_FALSE((translucent(scene, 0) || translucent(scene, 1)));
        CHECK(material_of(scene, 1).metallic == 1);
        Scene glass = scene;
        glass.instances.erase(glass.instances.begin());  // the floor reaches behind the camera
        const auto pixels = view_layers(glass, 128);
        CHECK(inside_picture(pixels, 128));
        for (std::size_t pane = 2; pane < 4; ++pane) {
            CHECK(translucent(glass, pane));
            CHECK((pixels_before(pixels, 1, pane) > 50 && pixels_before(pixels, pane, 1) > 50));  // the bubble
        }
        for (const std::size_t other : {3u, 4u})
            CHECK((pixels_before(pixels, 2, other) > 50 && pixels_before(pixels, other, 2) > 50));
        for (const Instance& instance : glass.instances)  // all above the floor
            for (const glm::vec3& p : glass.meshes[instance.mesh].positions)
                REQUIRE((instance.world_from_object * glm::dvec4(glm::dvec3(p), 1)).y > -1e-6);
    }
    CHECK(make_lit_glass(1).instances[3].world_from_object != make_lit_glass(2).instances[3].world_from_object);
    CHECK(make_lit_glass(1).materials[2].base_color != make_lit_glass(2).materials[2].base_color);
}

TEST_CASE("teapot grid: as many triangles as it says, all in view", "[cpu][sample_scenes]") {
    check_scene([] { return make_teapot_grid({.columns = 3, .rows = 2, .divisions = 6}); });
    const auto translucent_triangles = [](const Scene& scene) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
            if (translucent(scene, i)) count += scene.meshes[scene.instances[i].mesh].indices.size() / 3;
        return count;
    };
    CHECK(translucent_triangles(make_teapot_grid()) == 1003200);
    CHECK(translucent_triangles(make_teapot_grid({.columns = 3, .rows = 5, .divisions = 7})) == 15 * (64 * 49 - 56));
    CHECK(make_teapot_grid({.columns = 1, .rows = 1}).instances.size() == 2);
    const Scene scene = make_teapot_grid();
    CHECK(scene.meshes.size() == 7);
    const ClipFromView clip = clip_from_view(scene.cameras[0], {1920, 1080});
    const glm::dmat4 view_from_world = glm::inverse(scene.cameras[0].world_from_view);
    for (std::size_t i = 1; i < scene.instances.size(); ++i) {
        const glm::dvec4 e = view_from_world * scene.instances[i].world_from_object[3];
        REQUIRE(-e.z > scene.cameras[0].near);
        REQUIRE((std::abs(e.x * clip.sx) < -0.97 * e.z && std::abs(e.y * clip.sy) < -0.97 * e.z));
    }
}

TEST_CASE("sheets: the depth is the slot's, bit by bit", "[cpu][sample_scenes]") {
    check_scene([] {
        return make_sheets({{.slot = 3}, {.slot = 200, .color = {0.25f, 0.5f, 0.75f, 1}, .opaque = true}, {.slot = 3}});
    });
    const auto depths = [](const Scene& scene, Extent2D size) {
        const reference::ClipCoefficients<float> clip(clip_from_view(scene.cameras[0], size));
        std::vector<float> found;
        for (const Instance& instance : scene.instances) {
            REQUIRE(instance.world_from_object == glm::dmat4(1.0));
            const Mesh& mesh = scene.meshes[instance.mesh];
            for (const glm::vec3& p : mesh.positions)
                REQUIRE(reference::depth_from_view(clip, p) == reference::depth_from_view(clip, mesh.positions[0]));
            found.push_back(reference::depth_from_view(clip, mesh.positions[0]));
        }
        return found;
    };
    for (const std::uint32_t bits : {1u, 4u, 8u, 16u, 24u}) {
        std::vector<Sheet> sheets;
        const std::uint32_t end = 1u << bits, stride = std::max(end / 300, 1u);
        for (std::uint32_t slot = 1; slot < end; slot += stride) sheets.push_back({.slot = slot});
        sheets.push_back({.slot = end - 1});
        const Scene scene = make_sheets(sheets, bits);
        for (const Extent2D size : {Extent2D{64, 64}, Extent2D{1279, 713}}) {
            const std::vector<float> found = depths(scene, size);
            REQUIRE(found.size() == sheets.size());
            for (std::size_t i = 0; i < sheets.size(); ++i)
                REQUIRE(found[i] == std::ldexp(static_cast<float>(sheets[i].slot), -static_cast<int>(bits)));
        }
    }
    // One ulp apart, at the near and the far end of the upper half of depths; coplanar sheets are coplanar.
    for (const std::uint32_t slot : {1u << 23, (1u << 23) + 12345, (1u << 24) - 2}) {
        const auto found = depths(make_sheets({{.slot = slot}, {.slot = slot + 1}, {.slot = slot}}, 24), {100, 75});
        CHECK(std::nextafter(found[0], 2.0f) == found[1]);
        CHECK(found[2] == found[0]);
    }
    // Every pixel of square and wide pictures is covered once by each sheet.
    const Scene scene = make_sheets({{.slot = 1}, {.slot = 255}, {.slot = 128}});
    for (const std::vector<Layer>& layers : view_layers(scene, 32)) {
        REQUIRE(layers.size() == 3);
        CHECK((layers[0].instance == 1 && layers[1].instance == 2 && layers[2].instance == 0));
    }
    const ClipFromView wide = clip_from_view(scene.cameras[0], {400, 100});
    const std::vector<glm::vec3>& corners = scene.meshes[0].positions;
    CHECK(corners[0].x * wide.sx <= -1);
    CHECK(corners[0].y * wide.sy <= -1);
    // (1, 1) is on the inner side of the long edge.
    const glm::dvec2 b(corners[1].x * wide.sx, corners[1].y * wide.sy),
        c(corners[2].x * wide.sx, corners[2].y * wide.sy);
    CHECK((c - b).x * (1 - b.y) - (c - b).y * (1 - b.x) > 0);
    const Sheet opaque{.slot = 7, .color = {1, 0.5f, 0.25f, 1}, .opaque = true};
    const Scene one = make_sheets({opaque});
    CHECK((one.materials[0].alpha_mode == AlphaMode::opaque && one.materials[0].unlit));
    CHECK(one.materials[0].base_color == opaque.color);
    CHECK(make_sheets({{.color = {0, 0, 0, 1}}}).materials[0].alpha_mode == AlphaMode::blend);
}
