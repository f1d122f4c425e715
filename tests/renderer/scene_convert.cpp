// SPDX-License-Identifier: MIT
// CPU scene → GPU structs against values worked out by hand.
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/renderer/scene_convert.hpp>
#include "reference/sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;

namespace {
glm::dvec3 vec(const gpu::vec3& v) {
    return {v.x, v.y, v.z};
}
glm::dvec2 apply(const gpu::TextureUse& use, double u, double v) {
    return {double{use.matrix.x} * u + double{use.matrix.y} * v + double{use.offset.x},
            double{use.matrix.z} * u + double{use.matrix.w} * v + double{use.offset.y}};
}
bool near(glm::dvec2 a, glm::dvec2 b) {
    return glm::length(a - b) < 1e-6;
}
}  // namespace

TEST_CASE("KHR_texture_transform: scale, then rotation counter-clockwise in the picture, then offset", "[cpu]") {
    const std::vector<TexturePlan::Place> places = {{.array = 3, .layer = 300}};
    TextureRef ref{.texture = 0};
    gpu::TextureUse use = gpu_texture_use(ref, places);
    CHECK(near(apply(use, 0.25, 0.75), {0.25, 0.75}));
    CHECK(use.place == (4u | 300u << 8u));
    ref.offset = {0.5f, -0.25f};
    ref.scale = {2, 3};
    use = gpu_texture_use(ref, places);
    CHECK(near(apply(use, 0.25, 0.5), {1, 1.25}));
    // A quarter turn: v grows downwards, so counter-clockwise on the picture takes +u to -v and +v to +u.
    ref.rotation = static_cast<float>(std::numbers::pi / 2);
    use = gpu_texture_use(ref, places);
    CHECK(near(apply(use, 1, 0), {0.5, -0.25 - 2}));
    CHECK(near(apply(use, 0, 1), {0.5 + 3, -0.25}));
    // pi/6 of (1,1), scaled by (2,3): (2 cos + 3 sin, -2 sin + 3 cos)
    ref.rotation = static_cast<float>(std::numbers::pi / 6);
    ref.offset = {0, 0};
    const double c = std::sqrt(3.0) / 2, s = 0.5;
    CHECK(near(apply(gpu_texture_use(ref, places), 1, 1), {2 * c + 3 * s, -2 * s + 3 * c}));
    ref.uv_set = 1;
    CHECK(gpu_texture_use(ref, places).place == (4u | 300u << 8u | 1u << 24u));
    CHECK(gpu_texture_use({}, places).place == 0u);
    CHECK(gpu_texture_use(ref, {{}}).place == 0u);  // planned nowhere: its texture has no picture
}

TEST_CASE("the normal matrix is the inverse transpose, scaled; mirroring is noted", "[cpu]") {
    test::Random random(17);
    for (int i = 0; i < 200; ++i) {
        glm::dmat4 m = glm::rotate(glm::dmat4(1), random.uniform(0, 6), random.direction());
        m = m * glm::scale(glm::dmat4(1),
                           glm::dvec3(random.uniform(0.01, 100), random.uniform(-3, 3), random.uniform(-2, 5)));
        m[3] = glm::dvec4(random.uniform(-9, 9), random.uniform(-9, 9), 1, 1);
        gpu::DrawRecord r{};
        place(r, m);
        const glm::dmat3 wanted = glm::transpose(glm::inverse(glm::dmat3(m)));
        const glm::dvec3 n = random.direction();
        const glm::dvec3 got = vec(r.normal_x) * n.x + vec(r.normal_y) * n.y + vec(r.normal_z) * n.z;
        CHECK(test::degrees_between(got, wanted * n) < 1e-4);
        CHECK((r.flags & PELLUCID_DRAW_MIRRORED) ==
              (glm::determinant(glm::dmat3(m)) < 0 ? PELLUCID_DRAW_MIRRORED : 0u));
        double largest = 0;
        for (const gpu::vec3* v : {&r.normal_x, &r.normal_y, &r.normal_z})
            largest = std::max({largest, std::abs(double{v->x}), std::abs(double{v->y}), std::abs(double{v->z})});
        CHECK(largest == Approx(1.0));
        CHECK(glm::length(vec(r.origin) - glm::dvec3(m[3])) < 1e-5);
        CHECK(glm::length(vec(r.axis_y) - glm::dvec3(m[1])) < 1e-5);
    }
    // Flat: scale 0 in z leaves the normal of the plane it became.
    gpu::DrawRecord r{};
    place(r, glm::scale(glm::dmat4(1), glm::dvec3(2, 3, 0)));
    CHECK(vec(r.normal_z) == glm::dvec3(0, 0, 1));
    CHECK(vec(r.normal_x) == glm::dvec3(0));
    place(r, glm::dmat4(0));
    CHECK(vec(r.normal_z) == glm::dvec3(0));
    // Sizes whose determinant leaves float, and almost leaves double.
    for (const double scale : {1e-60, 1e-20, 1e20, 1e60}) {
        place(r, glm::scale(glm::dmat4(1), glm::dvec3(scale)));
        CHECK(vec(r.normal_x) == glm::dvec3(1, 0, 0));
    }
}

TEST_CASE("lights are placed in view space; a narrow cone keeps its digits", "[cpu]") {
    const glm::dmat4 world_from_view = look_at({1e5, 20, -3e4}, {1e5 + 1, 20, -3e4});  // looks along +x
    const glm::dmat4 view = rigid_inverse(world_from_view);
    CHECK(glm::length(view * world_from_view[3] - glm::dvec4(0, 0, 0, 1)) < 1e-9);
    Light light{.color = {1, 0.5f, 0.25f}, .intensity = 8, .range = 4, .position = {1e5 + 2.5, 20.5, -3e4 + 1}};
    gpu::LightRecord r = gpu_light(light, view);
    CHECK(glm::length(vec(r.position) - glm::dvec3(1, 0.5, -2.5)) < 1e-6);  // +z of the world is to the right
    CHECK(vec(r.intensity) == glm::dvec3(8, 4, 2));
    CHECK(r.inverse_range_squared == 0.0625f);
    light.range = 0;
    CHECK(gpu_light(light, view).inverse_range_squared == 0.0f);
    light.direction = {1, 0, 0};  // the way the view looks
    CHECK(glm::length(vec(gpu_light(light, view).to_light) - glm::dvec3(0, 0, 1)) < 1e-7);
    light.kind = LightKind::spot;
    for (const double outer : {0.05, 0.5, 5.0, 45.0, 90.0})
        for (const double part : {0.0, 0.5, 0.999}) {
            light.outer_cone = outer * std::numbers::pi / 180;
            light.inner_cone = part * light.outer_cone;
            r = gpu_light(light, view);
            const reference::SpotCone cone = reference::spot_cone(light.inner_cone, light.outer_cone);
            CHECK(r.spot_edge == Approx(cone.outer).epsilon(1e-7));
            CHECK(r.spot_scale == Approx(cone.scale).epsilon(1e-7));
        }
    light.inner_cone = light.outer_cone;  // a hard edge stays finite
    CHECK(std::isfinite(gpu_light(light, view).spot_scale));
}

TEST_CASE("colours are four 16-bit codes; k/255 is one of them", "[cpu]") {
    CHECK(pack_color({0, 1, 0, 1}).x == 0xFFFF0000u);
    CHECK(pack_color({0, 1, 0, 1}).y == 0xFFFF0000u);
    CHECK(pack_color({-1, 2, 0.5f, 1}).x == 0xFFFF0000u);
    CHECK((pack_color({0, 0, 0.5f, 0}).y & 0xFFFFu) == 32768u);
    for (std::uint32_t k = 0; k < 256; ++k)
        CHECK((pack_color({static_cast<float>(k) / 255.0f, 0, 0, 0}).x & 0xFFFFu) == k * 257);
}

TEST_CASE("meshes follow each other in the shared buffers; what a mesh lacks is filled in", "[cpu]") {
    Scene scene;
    Mesh a, b;
    a.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    a.normals.assign(3, {0, 1, 0});
    a.indices = {0, 1, 2};
    b = a;
    b.uv0.assign(3, {0.25f, 0.5f});
    b.uv1.assign(3, {0.75f, 1.5f});
    b.tangents.assign(3, {1, 0, 0, -1});
    b.colors.assign(3, {1, 0, 0, 1});
    b.indices = {0, 1, 2, 2, 1, 0};
    scene.meshes = {a, b, a};
    const MeshPlacement p = place_meshes(scene);
    CHECK(p.first_vertex == std::vector<std::uint32_t>{0, 3, 6});
    CHECK(p.first_index == std::vector<std::uint32_t>{0, 3, 9});
    CHECK(p.vertices == 9);
    CHECK(p.indices == 12);
    const std::vector<gpu::Vertex> v = gpu_vertices(scene);
    REQUIRE(v.size() == 9);
    CHECK(vec(v[1].position) == glm::dvec3(4, 5, 6));
    CHECK(v[0].color.x == 0xFFFFFFFFu);
    CHECK(v[0].u0 == 0.0f);
    CHECK(v[3].u0 == 0.25f);
    CHECK(v[3].v0 == 0.5f);
    CHECK(v[3].uv1.y == 1.5f);
    CHECK(v[3].tangent.w == -1.0f);
    CHECK(v[3].color.x == 0x0000FFFFu);
}

TEST_CASE("materials carry their factors and flags", "[cpu]") {
    Material m{.base_color = {0.1f, 0.2f, 0.3f, 0.4f}, .metallic = 0.5f, .roughness = 0.6f, .emissive = {7, 8, 9}};
    m.alpha_cutoff = 0.3f;
    gpu::MaterialRecord r = gpu_material(m, {});
    CHECK(r.base_color.w == 0.4f);
    CHECK(r.emissive.z == 9.0f);
    CHECK(r.metallic == 0.5f);
    CHECK(r.roughness == 0.6f);
    CHECK(r.alpha_cutoff == 0.3f);
    CHECK(r.flags == 0u);
    m.double_sided = m.unlit = true;
    m.alpha_mode = AlphaMode::mask;
    CHECK(gpu_material(m, {}).flags ==
          (PELLUCID_MATERIAL_DOUBLE_SIDED | PELLUCID_MATERIAL_UNLIT | PELLUCID_MATERIAL_MASK));
    m.alpha_mode = AlphaMode::blend;
    CHECK((gpu_material(m, {}).flags & PELLUCID_MATERIAL_BLEND) != 0u);
}

TEST_CASE("premultiplied materials carry their flag, beside all others", "[cpu]") {
    Material m{.alpha_mode = AlphaMode::blend, .premultiplied = true};
    CHECK(gpu_material(m, {}).flags == (PELLUCID_MATERIAL_BLEND | PELLUCID_MATERIAL_PREMULTIPLIED));
    m.base_color = {0.5f, 4, 0.25f, 0};  // what a shader multiplies is left to it
    const gpu::MaterialRecord r = gpu_material(m, {});
    CHECK(r.base_color.x == 0.5f);
    CHECK(r.base_color.y == 4.0f);
    CHECK(r.base_color.w == 0.0f);
    m.double_sided = m.unlit = true;
    CHECK(gpu_material(m, {}).flags == (PELLUCID_MATERIAL_BLEND | PELLUCID_MATERIAL_PREMULTIPLIED |
                                        PELLUCID_MATERIAL_DOUBLE_SIDED | PELLUCID_MATERIAL_UNLIT));
    m.premultiplied = false;
    CHECK((gpu_material(m, {}).flags & PELLUCID_MATERIAL_PREMULTIPLIED) == 0u);
}

TEST_CASE("triangles once more, the last one first, each with its corners in order", "[cpu]") {
    std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    const MeshPlacement p{.vertices = 12, .indices = 12};
    append_reversed_triangles(indices);
    REQUIRE(indices.size() == 24);
    const std::uint32_t wanted[] = {9, 10, 11, 6, 7, 8, 3, 4, 5, 0, 1, 2};
    for (std::size_t i = 0; i < 12; ++i) {
        CHECK(indices[i] == i);
        CHECK(indices[12 + i] == wanted[i]);
    }
    // A range of triangles, reversed, is a range: [3, 9) becomes 6 7 8, 3 4 5.
    CHECK(p.reversed_index(3, 6) == 15);
    CHECK(p.reversed_index(0, 12) == 12);
    CHECK(p.reversed_index(9, 3) == 12);
    std::vector<std::uint32_t> none;
    append_reversed_triangles(none);
    CHECK(none.empty());
}
