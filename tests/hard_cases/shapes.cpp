// SPDX-License-Identifier: MIT
// Surfaces that no order of whole objects gets right, and surfaces seen from their other side.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

constexpr std::uint32_t n = 64;

/// A rectangle through the middle of the view on the plane z = a x + b y + c, wider than the view.
std::uint32_t add_plane(Scene& scene, const glm::dvec3& abc, const Material& material) {
    Mesh mesh = quad(2, 2);
    for (glm::vec3& p : mesh.positions) p.z = static_cast<float>(abc.x * p.x + abc.y * p.y + abc.z);
    update_bounds(mesh);
    return add(scene, std::move(mesh), material);
}

/// Planes z = a x + b y + c before an orthographic camera: at every pixel their order is that of three numbers.
KnownScene intersecting() {
    const glm::dvec3 planes[] = {{0.75, 0.25, 0.01}, {-0.5, 0.375, -0.02}, {0.0625, -0.75, 0}, {0.25, 0.1875, 0.1}};
    const glm::vec4 colors[] = {
        {1, 0.25f, 0.125f, 0.5f}, {0.25f, 1, 0.5f, 0.25f}, {0.125f, 0.5f, 1, 0.75f}, {0.75f, 0.75f, 0.25f, 0.625f}};
    KnownScene known{.name = "four planes through each other", .camera = flat_camera(), .settings = settings_for(n)};
    for (int i = 0; i < 4; ++i) add_plane(known.scene, planes[i], flat(colors[i], AlphaMode::blend));
    double closest = 1;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const glm::dvec3 at((2 * x + 1.0) / n - 1, 1 - (2 * y + 1.0) / n, 1);
            std::vector<int> order{0, 1, 2, 3};
            const auto z = [&](int i) { return glm::dot(planes[i], at); };
            std::sort(order.begin(), order.end(), [&](int a, int b) { return z(a) > z(b); });
            std::vector<Layer> layers;
            for (const int i : order) layers.push_back(straight(colors[i]));
            for (int i = 0; i + 1 < 4; ++i) closest = std::min(closest, z(order[i]) - z(order[i + 1]));
            known.pixels.push_back(known_pixel(std::move(layers)));
        }
    // Depth is linear in z, 1/19 of it; interpolating it costs a few units of 2^-24.
    REQUIRE(closest > 1e-4);
    known.at = [](std::uint32_t x, std::uint32_t y) { return std::size_t{y} * n + x; };
    return known;
}

/// Where the ray through the middle of pixel (x, y) meets the triangle: [m] along -z, or less than 0; `margin` is
/// lowered to how near an edge is, in barycentric coordinates.
double distance_to(const Camera& camera, std::uint32_t x, std::uint32_t y, const glm::dvec3 (&p)[3], double& margin) {
    const double t = std::tan(0.5 * camera.vertical_fov);
    const glm::dvec3 eye(camera.world_from_view[3]);
    const glm::dvec3 ray =
        glm::dmat3(camera.world_from_view) * glm::dvec3(((2 * x + 1.0) / n - 1) * t, (1 - (2 * y + 1.0) / n) * t, -1);
    // eye + s ray = p0 + u (p1 - p0) + v (p2 - p0), by Cramer's rule
    const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], c = eye - p[0];
    const double det = glm::determinant(glm::dmat3(a, b, -ray));
    const double u = glm::determinant(glm::dmat3(c, b, -ray)) / det;
    const double v = glm::determinant(glm::dmat3(a, c, -ray)) / det;
    const double inside = std::min({u, v, 1 - u - v});
    margin = std::min(margin, std::abs(inside));
    return inside < 0 ? -1 : glm::determinant(glm::dmat3(a, b, c)) / det;
}

/// Three triangles in a cycle, and by rays through pixel centres what they look like.
KnownScene cyclic() {
    KnownScene known{
        .name = "three triangles in a cycle", .scene = make_cyclic_triangles(), .settings = settings_for(n)};
    known.camera = known.scene.cameras.front();
    std::vector<std::size_t> which;
    std::size_t overlapping = 0;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            std::vector<std::pair<double, Layer>> hits;
            double margin = 1;
            for (const Instance& instance : known.scene.instances) {
                const Mesh& mesh = known.scene.meshes[instance.mesh];
                glm::dvec3 p[3];
                for (int i = 0; i < 3; ++i)
                    p[i] = glm::dvec3(instance.world_from_object *
                                      glm::dvec4(mesh.positions[mesh.indices[static_cast<std::size_t>(i)]], 1));
                const double s = distance_to(known.camera, x, y, p, margin);
                if (s > 0) hits.emplace_back(s, straight(known.scene.materials[mesh.material].base_color));
            }
            std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
            std::vector<Layer> layers;
            for (const auto& hit : hits) layers.push_back(hit.second);
            overlapping += layers.size() > 1;
            // Closer to an edge than a thousandth of the triangle, drivers snap corners to a grid.
            which.push_back(margin < 1e-3 ? KnownScene::unknown : known.pixels.size());
            known.pixels.push_back(known_pixel(std::move(layers)));
        }
    REQUIRE(overlapping > 100);
    known.at = [which](std::uint32_t x, std::uint32_t y) { return which[std::size_t{y} * n + x]; };
    return known;
}

/// Three closed shells around the eye, cubes of one colour each: every pixel has exactly three layers, whatever edges
/// and corners it looks at.
KnownScene shells() {
    KnownScene known{.name = "closed shells around the eye", .settings = settings_for(n)};
    known.camera = {.vertical_fov = 2.2, .world_from_view = look_at({0.1, -0.05, 0.07}, {0.6, 0.5, -0.4})};
    const glm::vec4 colors[] = {{1, 0.25f, 0.125f, 0.5f}, {0.25f, 1, 0.5f, 0.25f}, {0.125f, 0.5f, 1, 0.75f}};
    for (const int i : {1, 0, 2}) {  // not in the order of their sizes
        Material m = flat(colors[i], AlphaMode::blend);
        m.double_sided = true;
        add(known.scene, make_cube(1), m, scaled(1 + i, 1 + i, 1 + i));
    }
    known.pixels = {known_pixel({straight(colors[0]), straight(colors[1]), straight(colors[2])})};
    known.at = [](std::uint32_t, std::uint32_t) { return std::size_t{0}; };
    return known;
}

/// A box of one colour before and another behind: both faces, one, or none is seen, mirrored or not.
KnownScene sides() {
    KnownScene known{
        .name = "one-sided and double-sided, mirrored and not", .camera = flat_camera(), .settings = settings_for(n)};
    const glm::vec4 front{1, 0.25f, 0.125f, 0.5f}, back{0.125f, 0.5f, 1, 0.25f};
    Mesh box = make_cube(0.5f);
    for (const glm::vec3& normal : box.normals) box.colors.push_back(normal.z > 0.5f ? front : back);
    known.pixels.push_back(known_pixel({}));
    for (int i = 0; i < 8; ++i) {
        const bool double_sided = i % 2, mirrored = i / 2 % 2, turned = i / 4;
        Material m = flat({1, 1, 1, 1}, AlphaMode::blend);
        m.double_sided = double_sided;
        glm::dmat4 world = at(-0.75 + 0.5 * (i % 4), turned ? -0.5 : 0.5, 0) *
                           glm::scale(glm::dmat4(1), glm::dvec3(mirrored ? -0.75 : 0.75, 0.75, 0.75));
        if (turned) world = glm::rotate(world, 3.14159265358979323846, glm::dvec3(0, 1, 0));
        add(known.scene, box, m, world);
        const Layer near = straight(turned ? back : front), far = straight(turned ? front : back);
        known.pixels.push_back(known_pixel(double_sided ? std::vector{near, far} : std::vector{near}));
    }
    known.at = [](std::uint32_t x, std::uint32_t y) {
        // Boxes of 12 pixels in the middles of cells of 16 x 32.
        const bool inside_x = (x % 16) >= 2 && (x % 16) < 14, inside_y = (y % 32) >= 10 && (y % 32) < 22;
        return inside_x && inside_y ? std::size_t{1} + x / 16 + 4 * (y / 32) : std::size_t{0};
    };
    return known;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: planes through each other", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = intersecting();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
    // Sorting whole objects is not enough, and the window shows it.
    CHECK(judge(composite<TestType>(*device, known, Transparency::sorted).hdr, known, Transparency::sorted,
                device->info().software)
              .outside > n * n / 4);
}

TEMPLATE_LIST_TEST_CASE("hard cases: triangles of which each is in front of the next", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = cyclic();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
}

TEMPLATE_LIST_TEST_CASE("hard cases: closed shells around the eye", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    KnownScene known = shells();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
    // Seen from inside, a one-sided shell is not there.
    for (Material& m : known.scene.materials) m.double_sided = false;
    known.name += ", one-sided";
    known.pixels = {known_pixel({})};
    check_known(known);
    check_exact<TestType>(*device, known);
}

TEMPLATE_LIST_TEST_CASE("hard cases: mirrored and double-sided instances", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = sides();
    check_known(known);
    check_exact<TestType>(*device, known);
    for (const Transparency method : {Transparency::sorted, Transparency::dual_peel})
        check_within<TestType>(*device, known, method);
}

TEST_CASE("hard cases: shapes are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{intersecting(), cyclic(), shells(), sides()});
}
