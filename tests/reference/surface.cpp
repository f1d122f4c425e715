// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <pellucid/reference/surface.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::degrees_between;
using pellucid::test::Random;

namespace {

/// One texel of these codes, read as it is.
SampledTexture texel(int r, int g, int b, int a = 255, bool srgb = false) {
    Image8 image(1, 1, 4);
    const int codes[] = {r, g, b, a};
    for (std::size_t i = 0; i < 4; ++i) image.data[i] = static_cast<std::uint8_t>(codes[i]);
    return sampled_texture(image, {}, srgb);
}
/// An upright frame: the surface faces +z, u runs along +x.
Attributes upright() {
    Attributes a;
    a.normal = {0, 0, 1};
    a.tangent = {1, 0, 0, 1};
    return a;
}
const glm::dvec3 nowhere(0, 1, 0);  // a fallback that no case here expects

glm::dvec3 mapped(const SampledTexture& map, const Attributes& a, bool front = true, float scale = 1) {
    TexturedMaterial m{.factors = {.normal_scale = scale}};
    m.normal.texture = &map;
    return shading_normal(m, a, {}, front, nowhere);
}

}  // namespace

TEST_CASE("surface: normals stay orthogonal to their surface under any matrix, and outside of mirrored bodies",
          "[cpu]") {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        glm::dmat4 m(1.0);
        for (int c = 0; c < 3; ++c) m[c] = glm::dvec4(random.direction() * std::pow(10.0, random.uniform(-3, 3)), 0);
        const Placement placed = placement(m);
        const glm::dvec3 along = random.direction(), normal = glm::normalize(glm::cross(along, random.direction()));
        const glm::dvec3 out = glm::normalize(placed.normal_from_object * normal);
        const glm::dvec3 moved = glm::normalize(glm::dmat3(m) * along);
        REQUIRE(std::abs(glm::dot(out, moved)) < 1e-7);
        // A point beyond the surface stays on the side that the normal shows, whatever the determinant's sign.
        REQUIRE(glm::dot(out, glm::dmat3(m) * normal) > 0);
        REQUIRE(placed.mirrored == (glm::determinant(glm::dmat3(m)) < 0));
    }
    // Flattened to the plane z = 0: the inverse does not exist, the normal does.
    const Placement flat = placement(glm::scale(glm::dmat4(1), glm::dvec3(2, 3, 0)));
    CHECK(glm::normalize(flat.normal_from_object * glm::normalize(glm::dvec3(1, 2, 3))) == glm::dvec3(0, 0, 1));
    CHECK_FALSE(flat.mirrored);
}

TEST_CASE("surface: vertices are placed, and attributes that a mesh lacks have their neutral values", "[cpu]") {
    Mesh mesh;
    mesh.positions = {{1, 2, 3}};
    mesh.normals = {{0, 0, 1}};
    const glm::dmat4 mirrored =
        glm::translate(glm::dmat4(1), glm::dvec3(10, 0, 0)) * glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 4));
    Attributes a = vertex_attributes(mesh, placement(mirrored), 0);
    CHECK(a.position == glm::dvec3(9, 2, 12));
    CHECK(a.normal == glm::dvec3(0, 0, 1));
    CHECK(a.tangent == glm::dvec4(0));
    CHECK(a.uv[0] == glm::dvec2(0));
    CHECK(a.color == glm::dvec4(1));
    mesh.tangents = {{1, 0, 0, 1}};
    mesh.uv0 = {{0.5f, 2}};
    mesh.uv1 = {{-1, 4}};
    mesh.colors = {{0.25f, 0.5f, 1, 0.75f}};
    a = vertex_attributes(mesh, placement(mirrored), 0);
    CHECK(a.tangent == glm::dvec4(-1, 0, 0, -1));  // handedness turns
    CHECK(a.uv[0] == glm::dvec2(0.5, 2));
    CHECK(a.uv[1] == glm::dvec2(-1, 4));
    CHECK(a.color == glm::dvec4(0.25, 0.5, 1, 0.75));
    CHECK(vertex_attributes(mesh, placement(glm::dmat4(1)), 0).tangent == glm::dvec4(1, 0, 0, 1));
    CHECK(glm::length(vertex_attributes(mesh, placement(glm::scale(glm::dmat4(1), glm::dvec3(1e-12))), 0).normal) ==
          Approx(1).epsilon(1e-14));
}

TEST_CASE("surface: texture coordinates are scaled, turned against the clock on the picture, and moved", "[cpu]") {
    const float quarter = static_cast<float>(std::numbers::pi / 2);
    const auto near = [](glm::dvec2 a, glm::dvec2 b) { return glm::length(a - b) < 1e-6; };  // the angle is a float
    CHECK(transformed_uv({.offset = {0.25f, -1}}, {1, 2}) == glm::dvec2(1.25, 1));
    CHECK(transformed_uv({.scale = {2, -0.5f}}, {1, 2}) == glm::dvec2(2, -1));
    // v runs down, so a quarter turn against the clock takes the u axis to −v.
    CHECK(near(transformed_uv({.rotation = quarter}, {1, 0}), {0, -1}));
    CHECK(near(transformed_uv({.rotation = quarter}, {0, 1}), {1, 0}));
    CHECK(near(transformed_uv({.offset = {10, 20}, .scale = {2, 3}, .rotation = quarter}, {1, 1}), {13, 18}));
    // Derivatives turn and scale with them: a level that depends on the scale, not on the offset.
    Image8 image(8, 8, 4);
    SampledTexture texture = sampled_texture(image, {}, false);
    for (std::size_t i = 0; i < texture.levels.size(); ++i)
        for (std::uint8_t& code : texture.levels[i].data) code = static_cast<std::uint8_t>(50 * i);
    UvDerivatives change;
    change.dx[1] = {1.0 / 8, 0};
    change.dy[1] = {0, 1.0 / 8};
    TextureUse use{.texture = &texture, .ref = {.texture = 0, .uv_set = 1, .offset = {5, 7}, .rotation = 0.3f}};
    CHECK(sample_use(use, upright(), change).r * 255 == Approx(0).margin(1e-5));
    use.ref.scale = {4, 1};
    CHECK(sample_use(use, upright(), change).r * 255 == Approx(100).epsilon(1e-6));
    use.ref.uv_set = 0;  // that one does not change
    CHECK(sample_use(use, upright(), change).r == 0);
    CHECK(sample_use({}, upright(), change) == glm::dvec4(1));
}

TEST_CASE("surface: normal maps point along tangent, bitangent and normal", "[cpu]") {
    const Attributes a = upright();
    const auto near = [](glm::dvec3 found, glm::dvec3 expected) {
        return degrees_between(found, glm::normalize(expected)) < 1e-9;
    };
    // Codes 255 and 0 are 1 and −1; 51 and 204 are −0.6 and 0.6.
    CHECK(near(mapped(texel(255, 204, 204), a), {1, 0.6, 0.6}));
    CHECK(near(mapped(texel(51, 0, 204), a), {-0.6, -1, 0.6}));  // +v of the tangent frame is up
    CHECK(near(mapped(texel(255, 204, 204), a, true, 0.5f), {0.5, 0.3, 0.6}));
    CHECK(near(mapped(texel(255, 204, 204), a, true, -1), {-1, -0.6, 0.6}));
    // The other handedness turns the bitangent alone; a back face turns the whole.
    Attributes left = a;
    left.tangent.w = -1;
    CHECK(near(mapped(texel(255, 204, 204), left), {1, -0.6, 0.6}));
    CHECK(near(mapped(texel(255, 204, 204), a, false), {-1, -0.6, -0.6}));
    // What is interpolated is not made unit before: a shorter normal weighs less (and makes the bitangent shorter).
    Attributes bent = a;
    bent.normal = {0, 0, 0.5};
    CHECK(near(mapped(texel(255, 204, 204), bent), {1, 0.3, 0.3}));
    // A mirrored instance of an upright frame shows the mirrored normal.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}};
    mesh.normals = {{0, 0, 1}};
    mesh.tangents = {{1, 0, 0, 1}};
    const Attributes mirrored = vertex_attributes(mesh, placement(glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1))), 0);
    CHECK(near(mapped(texel(255, 204, 204), mirrored), {1, -0.6, 0.6}));
}

TEST_CASE("surface: where there is no direction the fallback stands in, also turned on back faces", "[cpu]") {
    TexturedMaterial plain;
    Attributes none;
    CHECK(shading_normal(plain, none, {}, true, nowhere) == nowhere);
    CHECK(shading_normal(plain, none, {}, false, nowhere) == -nowhere);
    none.normal = {1e-200, 0, 0};
    CHECK(shading_normal(plain, none, {}, true, nowhere) == nowhere);
    // A map whose texel is the zero vector leaves the interpolated normal.
    const SampledTexture zero = [] {
        Image8 pair(2, 1, 4);
        pair.data = {0, 0, 0, 255, 255, 255, 255, 255};
        return sampled_texture(pair, {.mipmapped = false}, false);
    }();
    Attributes between = upright();
    between.uv[0] = {0.5, 0.5};
    CHECK(mapped(zero, between) == glm::dvec3(0, 0, 1));
    CHECK(shading_normal(plain, upright(), {}, false, nowhere) == glm::dvec3(0, 0, -1));
}

TEST_CASE("surface: factors, textures and vertex colours multiply, each from its channels", "[cpu]") {
    const SampledTexture base = texel(255, 128, 0, 51, true), rough = texel(10, 51, 102), dim = texel(102, 0, 0),
                         glow = texel(255, 0, 128, 255, true);
    TexturedMaterial m{.factors = {.base_color = {0.5f, 0.5f, 1, 0.5f},
                                   .metallic = 0.5f,
                                   .roughness = 0.25f,
                                   .emissive = {2, 3, 4},
                                   .occlusion_strength = 0.5f}};
    m.base_color.texture = &base;
    m.metallic_roughness.texture = &rough;
    m.occlusion.texture = &dim;
    m.emissive.texture = &glow;
    Attributes a = upright();
    a.color = {1, 0.5, 0.25, 0.5};
    const double half = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
    const glm::dvec4 color = base_color(m, a, {});
    CHECK(color.r == Approx(0.5).epsilon(1e-14));
    CHECK(color.g == Approx(0.25 * half).epsilon(1e-14));
    CHECK(color.b == 0);
    CHECK(color.a == Approx(0.5 * 0.2 * 0.5).epsilon(1e-14));
    const Surface<double> s = surface_at(m, a, {}, true, nowhere);
    CHECK(s.base_color == glm::dvec3(color));
    CHECK(s.metallic == Approx(0.5 * 0.4).epsilon(1e-14));
    CHECK(s.roughness == Approx(0.25 * 0.2).epsilon(1e-14));
    CHECK(s.occlusion == Approx(1 - 0.5 * 0.6).epsilon(1e-14));
    CHECK(s.emissive.r == Approx(2).epsilon(1e-14));
    CHECK(s.emissive.g == 0);
    CHECK(s.emissive.b == Approx(4 * half).epsilon(1e-14));
    CHECK(s.normal == glm::dvec3(0, 0, 1));
}

TEST_CASE("surface: alpha means what the material's mode says", "[cpu]") {
    const Material opaque, mask{.alpha_cutoff = 0.5f, .alpha_mode = AlphaMode::mask},
        blend{.alpha_mode = AlphaMode::blend};
    CHECK(passes_mask(opaque, 0));
    CHECK(passes_mask(blend, 0));
    CHECK(passes_mask(mask, 0.5));
    CHECK_FALSE(passes_mask(mask, std::nextafter(0.5, 0.0)));
    CHECK(fragment_alpha(opaque, 0.3) == 1);
    CHECK(fragment_alpha(mask, 0.6) == 1);
    CHECK(fragment_alpha(blend, 0.3) == 0.3);
    CHECK(fragment_alpha(blend, -0.5) == 0);
    CHECK(fragment_alpha(blend, 1.5) == 1);
}
