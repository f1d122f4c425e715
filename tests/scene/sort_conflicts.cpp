// SPDX-License-Identifier: MIT
// The detector of scenes that object sorting cannot draw right: what it must find, and what it must not cry about.
#include <glm/gtc/matrix_transform.hpp>
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <pellucid/scene/sort_conflicts.hpp>
#include <pellucid/scene/teapot.hpp>
#include "support/catch.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::add;
using test::at;

namespace {
constexpr Extent2D size{64, 64};

Material glass() {
    Material m = test::flat({0.2f, 0.5f, 0.9f, 0.5f}, AlphaMode::blend);
    m.double_sided = true;
    return m;
}
Camera from(glm::dvec3 eye, glm::dvec3 target = {0, 0, 0}) {
    return {.near = 0.01, .world_from_view = look_at(eye, target)};
}
/// What is found of one mesh alone, in glass.
SortConflicts alone(Mesh mesh, const Camera& camera, const glm::dmat4& world = glm::dmat4(1)) {
    Scene scene;
    add(scene, std::move(mesh), glass(), world);
    return find_sort_conflicts(scene, camera, size);
}
Mesh grid(std::uint32_t n, double height(double, double)) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            const double u = 2.0 * x / n - 1, v = 2.0 * y / n - 1;
            mesh.positions.push_back(glm::vec3(u, height(u, v), v));
            mesh.normals.push_back({0, 1, 0});
        }
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
    update_bounds(mesh);
    return mesh;
}
const glm::dvec3 directions[] = {{3, 0.7, 1.1}, {-0.4, 2.9, 0.3}, {0.2, -3, 1}, {-2, -1.5, -2.2}, {0.1, 0.2, 5}};
}  // namespace

TEST_CASE("convex bodies, rectangles and gentle sheets do not overlap themselves", "[cpu]") {
    for (const glm::dvec3& eye : directions) {
        INFO("from " << eye.x << ", " << eye.y << ", " << eye.z);
        CHECK(alone(make_cube(1), from(eye)).exact());
        CHECK(alone(make_uv_sphere(0.8f, 24, 48), from(eye)).exact());
        CHECK(alone(make_uv_sphere(0.8f, 2, 3), from(eye)).exact());
        CHECK(alone(make_icosphere(0.8f, 4), from(eye)).exact());
        CHECK(alone(make_plane(1, 2), from(eye)).exact());
        CHECK(alone(grid(16, [](double, double) { return 0.0; }), from(eye)).exact());
        CHECK(alone(make_cube(1), from(eye), at(0.3, 0, 0.1) * test::scaled(-1, 0.1, 2)).exact());
    }
    // A dome of many triangles, from above and from below; from the side it is in its own way.
    Mesh dome = grid(32, [](double x, double z) { return 0.3 * (2 - x * x - z * z); });
    CHECK(alone(dome, from({0.3, 4, 0.2})).exact());
    CHECK(alone(dome, from({0.3, -4, 0.2})).exact());
    CHECK(alone(dome, from({4, 0.3, 0})).self_overlapping == std::vector<std::uint32_t>{0});
    // Seen exactly along a face, and from inside.
    const Camera flat{.projection = Projection::orthographic,
                      .half_width = 2,
                      .half_height = 2,
                      .near = 0,
                      .far = 10,
                      .world_from_view = at(0, 0, 5)};
    CHECK(alone(make_cube(1), flat).exact());
    CHECK(alone(make_cube(1), from({0.5, 0.1, 3}, {0.5, 0, 0})).exact());
    CHECK(alone(make_cube(1), from({0.1, 0.1, 0.1}, {1, 0, 0})).exact());
}

TEST_CASE("what overlaps itself is found", "[cpu]") {
    const Camera camera = from({2, 1.5, 3});
    const auto overlaps = [&](Mesh mesh) { return alone(std::move(mesh), camera).self_count == 1; };
    CHECK(overlaps(make_torus(1, 0.3f, 24, 12)));
    CHECK(overlaps(make_teapot(6)));
    // Two boxes in one mesh.
    Mesh two = make_cube(0.5f), other = make_cube(0.5f);
    for (const std::uint32_t i : other.indices)
        two.indices.push_back(i + static_cast<std::uint32_t>(two.positions.size()));
    for (const glm::vec3& p : other.positions) two.positions.push_back(p + glm::vec3(0, 0, 1));
    two.normals.insert(two.normals.end(), other.normals.begin(), other.normals.end());
    update_bounds(two);
    CHECK(overlaps(two));
    // One inside the other.
    two = make_cube(1);
    for (std::size_t i = 0; i < other.indices.size(); ++i) two.indices.push_back(two.indices[i] + 24);
    two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
    two.normals.insert(two.normals.end(), other.normals.begin(), other.normals.end());
    CHECK(overlaps(two));
    // A box with a dent, one without a lid, one inside out, and one twice.
    Mesh box = make_cube(1), dented = make_icosphere(1, 2), open = box, inverted = box, twice = box;
    for (glm::vec3& p : dented.positions)
        if (p.z > 0.9f) p.z = 0.2f;
    CHECK(overlaps(dented));
    open.indices.resize(open.indices.size() - 6);
    CHECK(overlaps(open));
    for (std::size_t i = 0; i < inverted.indices.size(); i += 3)
        std::swap(inverted.indices[i], inverted.indices[i + 1]);
    CHECK(overlaps(inverted));
    twice.indices.insert(twice.indices.end(), box.indices.begin(), box.indices.end());
    CHECK(overlaps(twice));
    // Waves seen at a low angle, two rectangles that share a plane and overlap, and a sheet with a hole.
    CHECK(alone(grid(32, [](double x, double) { return 0.2 * std::sin(8 * x); }), from({4, 0.8, 0})).self_count == 1);
    Mesh pair = test::quad();
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) pair.indices.push_back(i + 4);
    for (std::size_t i = 0; i < 4; ++i) pair.positions.push_back(pair.positions[i] + glm::vec3(0.5f, 0, 0));
    pair.normals.assign(8, {0, 0, 1});
    CHECK(overlaps(pair));
    Mesh one_and_a_half = test::quad();
    one_and_a_half.indices.insert(one_and_a_half.indices.end(), {0, 1, 2});
    CHECK(overlaps(one_and_a_half));
    Mesh fold = grid(8, [](double, double) { return 0.0; });
    fold.positions[4 * 9 + 4].x += 0.6f;
    CHECK(overlaps(fold));
    // A path round three sides of a square that sinks on its way: all of it faces the eye, and yet a ray meets both
    // ends.
    Mesh path = grid(3, [](double x, double z) { return (x < 0 ? 0.3 : -0.3) * std::max(0.0, 0.25 - 0.75 * z); });
    std::vector<std::uint32_t> kept;
    for (std::uint32_t cell = 0; cell < 9; ++cell)
        if (cell != 1 && cell != 4)
            kept.insert(kept.end(), path.indices.begin() + 6 * cell, path.indices.begin() + 6 * cell + 6);
    path.indices = kept;
    CHECK(alone(path, from({-5, 2, -0.9}, {0, 0, -0.9})).self_count == 1);
    // A fan that goes round its middle twice before it closes.
    Mesh fan;
    fan.positions = {{0, 0, 0}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        fan.positions.push_back(
            glm::vec3(std::cos(1.570796 * i), 0.01f * static_cast<float>(i), -std::sin(1.570796 * i)));
        fan.indices.insert(fan.indices.end(), {0, 1 + i, 1 + (i + 1) % 8});
    }
    fan.normals.assign(9, {0, 1, 0});
    update_bounds(fan);
    CHECK(alone(fan, from({0.1, 4, 0.2})).self_count == 1);
    Mesh hole = grid(8, [](double, double) { return 0.0; });
    hole.indices.erase(hole.indices.begin() + 6 * 27, hole.indices.begin() + 6 * 28);
    CHECK(overlaps(hole));
}

TEST_CASE("the valley that a body shows decides, not the valley that it has", "[cpu]") {
    // A prism over an L: its one valley runs along z.
    Mesh mesh;
    const glm::vec2 outline[] = {{-1, -1}, {1, -1}, {1, 0}, {0, 0.02f}, {0, 1}, {-1, 1}};
    for (const float z : {-0.2f, 0.2f})
        for (const glm::vec2& p : outline) mesh.positions.push_back({p, z});
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.indices.insert(mesh.indices.end(), {i, j, 6 + i, j, 6 + j, 6 + i});
    }
    for (const glm::uvec3& t : {glm::uvec3(0, 1, 2), {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
        mesh.indices.insert(mesh.indices.end(), {6 + t.x, 6 + t.y, 6 + t.z});
        mesh.indices.insert(mesh.indices.end(), {t.x, t.z, t.y});
    }
    mesh.normals.assign(12, {0, 0, 1});
    update_bounds(mesh);
    CHECK(alone(mesh, from({4, 4, 1})).exact());             // into the L: both of its sides face the eye
    CHECK(alone(mesh, from({-4, -4, 1})).exact());           // from behind: neither does
    CHECK(alone(mesh, from({4, -2, 1})).self_count == 1);    // over one arm at the other
    CHECK(alone(mesh, from({-2, 4, 0.5})).self_count == 1);  // the same from the other side
}

TEST_CASE("pairs overlap where their bounds do, in depth and on screen", "[cpu]") {
    const auto conflicts = [](const glm::dmat4& a, const glm::dmat4& b, const Camera& camera) {
        Scene scene;
        add(scene, make_cube(1), test::matte({1, 1, 1}), at(0, 0, -0.2));  // opaque ones do not count
        add(scene, test::quad(), glass(), a);
        add(scene, test::quad(), glass(), b);
        return find_sort_conflicts(scene, camera, size);
    };
    const Camera camera = from({0, 0, 5});
    CHECK(conflicts(at(0, 0, 0), at(0, 0, 0.001), camera).exact());
    CHECK(conflicts(at(0, 0, 0), at(0.5, 0, 0), camera).pairs == std::vector<SortConflicts::Pair>{{1, 2}});
    CHECK(conflicts(at(0, 0, 0), at(0, 0, 1e-9), camera).pair_count == 1);  // too near to tell in float
    CHECK(conflicts(at(-1.1, 0, 0), at(1.1, 0, 0), camera).exact());        // side by side
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1), 0.8, glm::dvec3(0, 1, 0));
    CHECK(conflicts(turned, at(0, 0, 0.3), camera).pair_count == 1);
    CHECK(conflicts(turned, at(0, 0, 2), camera).exact());
    // Behind the camera, and through the near plane: what is behind it must not be projected as it is.
    CHECK(conflicts(at(0, 0, 6), at(0, 0, 6), camera).instances == 0);
    const glm::dmat4 through = at(0.2, 0, 4.6) * glm::rotate(glm::dmat4(1), 1.5707, glm::dvec3(0, 1, 0));
    CHECK(conflicts(through, at(1.15, 0, 4.5), camera).pair_count == 1);
    CHECK(conflicts(through, at(1.15, 0, 2), camera).exact());
    Camera flat = test::flat_camera();
    CHECK(conflicts(at(0, 0, 0), at(0, 0, 0), flat).pair_count == 1);
    CHECK(conflicts(at(0, 0, -11), at(0, 0, -11), flat).instances == 0);
    // A matrix that is no matrix overlaps everything.
    glm::dmat4 broken(1);
    broken[3].x = std::numeric_limits<double>::quiet_NaN();
    CHECK(conflicts(broken, at(0, 0, 2), camera).pair_count == 1);
    CHECK_FALSE(alone(make_cube(1), camera, test::scaled(1, 0, 1)).exact());  // flattened: its sides coincide
    CHECK(alone(make_plane(1, 1), camera, test::scaled(1, 0, 1)).exact());
}

TEST_CASE("the sample scenes that no order draws right are found, and sheets are not blamed", "[cpu]") {
    const auto found = [](const Scene& scene) { return find_sort_conflicts(scene, scene.cameras.front(), {256, 256}); };
    CHECK(found(make_cyclic_triangles()).pair_count == 3);
    CHECK(found(make_cyclic_triangles()).self_count == 0);
    CHECK(found(make_intersecting_planes()).pair_count == 3);
    CHECK(found(make_intersecting_planes()).self_count == 0);
    CHECK(found(make_linked_chain(8)).pair_count >= 8);
    CHECK(found(make_linked_chain(8)).self_count == 8);
    CHECK(found(make_peeling_scene()).pair_count == 3);
    CHECK(found(make_lit_glass()).pair_count >= 3);
    CHECK(found(make_random_quads(64)).self_count == 0);
    CHECK(found(make_random_quads(64)).pair_count > 32);
    const Scene sheets = make_sheets({{.slot = 32}, {.slot = 128}, {.slot = 192}, {.slot = 64}});
    CHECK(found(sheets).exact());
    CHECK(found(make_sheets({{.slot = 32}, {.slot = 32}})).pair_count == 1);
}

TEST_CASE("long lists end, and the sentence says how many there are", "[cpu]") {
    Scene scene;
    add(scene, test::quad(), glass());
    for (int i = 0; i < 99; ++i) scene.instances.push_back(scene.instances[0]);
    SortConflicts found = find_sort_conflicts(scene, from({0, 0, 5}), size);
    CHECK(found.instances == 100);
    CHECK(found.pair_count == 4950);
    CHECK(found.pairs.size() == SortConflicts::most_listed);
    CHECK(found.pairs[0] == SortConflicts::Pair{0, 1});
    CHECK(found.pairs[63] == SortConflicts::Pair{0, 64});
    CHECK(to_text(found) ==
          "object sorting cannot be exact here, as far as bounds and shapes tell: of 100 translucent instances 4950 "
          "pairs "
          "overlap in depth and on screen (0 and 1, 0 and 2, 0 and 3, ...)");
    CHECK(to_text(alone(make_torus(1, 0.3f, 8, 8), from({2, 2, 2}))) ==
          "object sorting cannot be exact here, as far as bounds and shapes tell: of 1 translucent instances 1 may "
          "overlap "
          "themselves (0)");
    CHECK(to_text(SortConflicts{}).empty());
    // So many that they are not all compared: conflicts are assumed.
    scene.instances.resize(1);
    for (int i = 0; i < 12000; ++i) scene.instances.push_back(scene.instances[0]);
    found = find_sort_conflicts(scene, from({0, 0, 5}), size);
    CHECK_FALSE(found.complete);
    CHECK_FALSE(found.exact());
    CHECK(to_text(found).find("too many share depths to compare them all; at least ") != std::string::npos);
}
