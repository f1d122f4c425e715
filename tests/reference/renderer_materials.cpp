// SPDX-License-Identifier: MIT
// Materials and textures in whole pictures, against values worked out by hand.
#include <cmath>
#include <numbers>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/tangents.hpp>
#include <vector>
#include "support/scene.hpp"

using namespace pellucid;
using namespace pellucid::test;
using reference::Picture;
using reference::render;
using reference::RenderOptions;

namespace {

/// A texture of the scene, `[height, width]`, from a function of the texel that gives RGBA codes.
template <class F>
std::uint32_t add_texture(Scene& scene, std::uint32_t width, std::uint32_t height, const TextureSampler& sampler,
                          F&& code) {
    Image8 image(width, height, 4);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::ivec4 c = code(static_cast<int>(x), static_cast<int>(y));
            for (int k = 0; k < 4; ++k) image.texel(x, y)[k] = static_cast<std::uint8_t>(c[k]);
        }
    scene.images.push_back({std::move(image), ""});
    scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), sampler});
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}
Material textured(std::uint32_t texture, AlphaMode mode = AlphaMode::opaque) {
    Material m = flat({1, 1, 1, 1}, mode);
    m.base_color_texture.texture = texture;
    return m;
}
constexpr TextureSampler point{
    .min = TextureFilter::nearest, .mag = TextureFilter::nearest, .mip = TextureFilter::nearest, .mipmapped = false};
double linear_of(int code) {
    return code / 255.0 <= 0.04045 ? code / 255.0 / 12.92 : std::pow((code / 255.0 + 0.055) / 1.055, 2.4);
}
double red(const Picture& p, std::uint32_t x, std::uint32_t y) {
    return p.radiance.texel(x, y)[0];
}

}  // namespace

TEST_CASE("reference: texels appear where glTF puts them, row 0 at the top", "[cpu]") {
    Scene scene;
    const std::uint32_t t =
        add_texture(scene, 4, 2, point, [](int x, int y) { return glm::ivec4(10 + 50 * x + 20 * y, 0, 0, 255); });
    add(scene, quad(), textured(t));
    const Picture p = must(render(scene, flat_camera(), {.size = {8, 8}}));
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x)
            CHECK(red(p, x, y) == Approx(linear_of(static_cast<int>(10 + 50 * (x / 2) + 20 * (y / 4)))).epsilon(1e-6));
    // A texture without an image, and a transform: half as wide, so that the picture is repeated.
    scene.materials[0].base_color_texture.scale = {2, 1};
    const Picture twice = must(render(scene, flat_camera(), {.size = {8, 8}}));
    for (std::uint32_t x = 0; x < 8; ++x)
        CHECK(red(twice, x, 1) == Approx(linear_of(static_cast<int>(10 + 50 * (x % 4)))).epsilon(1e-6));
    scene.textures[0].image = no_index;
    CHECK(red(must(render(scene, flat_camera(), {.size = {8, 8}})), 1, 1) == 1);
}

TEST_CASE("reference: stripes of one texel fade to grey by the level that their size on screen asks for", "[cpu]") {
    // 64 stripes, black and white.  From level 1 on all is grey: the mean 0.5 in linear light, stored as code 188.
    const double grey = linear_of(188);
    for (const float scale : {0.25f, 1.0f, 1.2f, 1.75f, 2.0f, 3.0f})
        for (const TextureFilter mip : {TextureFilter::nearest, TextureFilter::linear})
            for (const TextureFilter min : {TextureFilter::nearest, TextureFilter::linear})
                for (const TextureFilter mag : {TextureFilter::nearest, TextureFilter::linear}) {
                    CAPTURE(scale, int(mip), int(min), int(mag));
                    Scene scene;
                    const std::uint32_t t =
                        add_texture(scene, 64, 64, {.min = min, .mag = mag, .mip = mip},
                                    [](int x, int) { return glm::ivec4(glm::ivec3(x % 2 ? 255 : 0), 255); });
                    add(scene, quad(), textured(t));
                    scene.materials[0].base_color_texture.scale = {scale, 1};
                    scene.materials[0].base_color_texture.offset = {0.003f, 0};
                    const Picture p = must(render(scene, flat_camera(), {.size = {64, 64}}));
                    // One stripe a pixel at scale 1; rows always are one texel a pixel, so λ >= 0.  At λ = 0 rounding
                    // decides between `mag` and `min`: only where they are the same filter is there one answer.
                    const double lambda = std::max(0.0, std::log2(static_cast<double>(scale)));
                    if (lambda == 0 && min != mag) continue;
                    const TextureFilter filter = lambda > 0 ? min : mag;
                    const double share =
                        mip == TextureFilter::linear ? std::min(lambda, 1.0) : (lambda > 0.5 ? 1.0 : 0.0);
                    for (std::uint32_t x = 0; x < 64; ++x) {
                        const double at = (x + 0.5) * scale + 0.003f * 64;
                        const double along = at - 0.5 - std::floor(at - 0.5);
                        const bool white_left = static_cast<int>(std::floor(at - 0.5)) & 1;
                        const double fine = filter == TextureFilter::nearest
                                                ? (static_cast<int>(std::floor(at)) & 1 ? 1.0 : 0.0)
                                                : (white_left ? 1 - along : along);
                        CHECK(red(p, x, 20) == Approx(fine * (1 - share) + grey * share).epsilon(1e-6).margin(1e-6));
                    }
                }
}

TEST_CASE("reference: a masked texture cuts holes, and what is left is opaque", "[cpu]") {
    Scene scene;
    const std::uint32_t t =
        add_texture(scene, 8, 8, point, [](int x, int y) { return glm::ivec4(255, 0, 0, (x + y) % 2 ? 128 : 127); });
    Material mask = textured(t, AlphaMode::mask);
    mask.alpha_cutoff = 0.5f;
    const Material glass = flat({0, 0, 1, 0.5f}, AlphaMode::blend), wall = flat({0, 1, 0, 1});
    add(scene, quad(), glass, at(0, 0, -1));
    add(scene, quad(), mask);
    add(scene, quad(), glass, at(0, 0, 1));
    add(scene, quad(), wall, at(0, 0, -2));
    const RenderOptions options{.size = {8, 8}, .stability = true};
    const Picture p = must(render(scene, flat_camera(), options));
    for (std::uint32_t y = 0; y < 8; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            CAPTURE(x, y);
            const bool there = (x + y) % 2;
            CHECK(*p.layers.texel(x, y) == (there ? 1 : 2));
            CHECK(p.radiance.texel(x, y)[0] == (there ? 0.5f : 0.0f));
            CHECK(p.radiance.texel(x, y)[1] == (there ? 0.0f : 0.25f));
            CHECK(p.radiance.texel(x, y)[2] == (there ? 0.5f : 0.75f));
            if (x != y) CHECK(*p.stable.texel(x, y) == 255);  // holes end on pixel borders here
        }
    // Alpha equal to the cutoff is there; a constant stays what it is when it is interpolated.
    Scene equal;
    Mesh colored = quad(1.7f, 1.3f);
    colored.colors.assign(4, {1, 1, 1, 0.3f});
    Material half = flat({1, 1, 1, 1}, AlphaMode::mask);
    half.alpha_cutoff = 0.3f;
    add(equal, colored, half, glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(1, 2, 0)));
    const Picture whole =
        must(render(equal, {.vertical_fov = 0.18, .world_from_view = at(0, 0, 10)}, {.size = {31, 31}}));
    for (std::size_t i = 0; i < whole.radiance.data.size(); ++i) REQUIRE(whole.radiance.data[i] == 1.0f);
}

TEST_CASE("reference: alpha is factor times texture times vertex colour", "[cpu]") {
    Scene scene;
    const std::uint32_t t = add_texture(scene, 1, 1, {}, [](int, int) { return glm::ivec4(255, 255, 255, 102); });
    Mesh mesh = quad();
    mesh.colors.assign(4, {0.5f, 1, 1, 0.5f});
    Material m = textured(t, AlphaMode::blend);
    m.base_color = {1, 0.5f, 1, 0.75f};
    add(scene, mesh, m);
    const Picture p = must(render(scene, flat_camera(), {.size = {8, 8}, .background = {1, 1, 0}}));
    const double alpha = 0.4 * 0.5 * 0.75;
    CHECK(p.radiance.texel(5, 5)[0] == Approx(0.5 * alpha + 1 - alpha).epsilon(1e-6));
    CHECK(p.radiance.texel(5, 5)[1] == Approx(0.5 * alpha + 1 - alpha).epsilon(1e-6));
    CHECK(p.radiance.texel(5, 5)[2] == Approx(alpha).epsilon(1e-6));
    // Opaque: alpha means nothing.
    scene.materials[0].alpha_mode = AlphaMode::opaque;
    CHECK(must(render(scene, flat_camera(), {.size = {8, 8}, .background = {1, 1, 0}})).radiance.texel(5, 5)[2] == 1);
}

TEST_CASE("reference: vertex colours are interpolated in space, not on screen", "[cpu]") {
    // A strip from z = −1 (black) to z = −9 (white) under the eye: colour is (distance − 1)/8, distance = 1/tan(angle).
    Scene scene;
    Mesh strip;
    strip.positions = {{-50, -0.5f, -1}, {50, -0.5f, -1}, {50, -0.5f, -9}, {-50, -0.5f, -9}};
    strip.normals.assign(4, {0, 1, 0});
    strip.colors = {{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}};
    strip.indices = {0, 1, 2, 0, 2, 3};
    update_bounds(strip);
    add(scene, strip, flat({1, 1, 1, 1}));
    const Picture p = must(render(scene, {.vertical_fov = std::numbers::pi / 2, .near = 0.01}, {.size = {16, 32}}));
    int inside = 0;
    for (std::uint32_t y = 0; y < 32; ++y) {
        const double distance = 0.5 / ((y + 0.5 - 16) / 16);
        if (distance < 1 || distance > 9) continue;
        ++inside;
        for (std::uint32_t x = 0; x < 16; ++x)
            CHECK(red(p, x, y) == Approx((distance - 1) / 8).epsilon(2e-7).margin(1e-7));
    }
    CHECK(inside >= 7);
}

TEST_CASE("reference: a normal map turns the surface to its light, mirrored and seen from behind too", "[cpu]") {
    // Code (218, 128, 218) leans towards +u by 45 degrees.  A light from +x or −x at 45 degrees above the surface.
    Scene scene;
    const std::uint32_t t = add_texture(scene, 1, 1, {}, [](int, int) { return glm::ivec4(218, 128, 218, 255); });
    Mesh mesh = quad();
    make_tangents(mesh);
    Material m = matte({1, 1, 1});
    m.double_sided = true;
    m.normal_texture.texture = t;
    add(scene, mesh, m);
    const double lean = 218 / 255.0 * 2 - 1, rest = 128 / 255.0 * 2 - 1;
    const auto lit = [&](const glm::dmat4& world, double from_x) {
        scene.instances[0].world_from_object = world;
        RenderOptions options{.size = {8, 8}, .brdf = reference::BrdfModel::blinn_phong};
        options.lights = {{.kind = LightKind::directional, .direction = glm::normalize(glm::dvec3(-from_x, 0, -1))}};
        return red(must(render(scene, flat_camera(), options)), 3, 3);
    };
    const auto expected = [&](glm::dvec3 normal, double from_x) {
        const reference::Surface<double> s{.normal = glm::normalize(normal), .base_color = {1, 1, 1}};
        return reference::evaluate_blinn_phong(s, {0, 0, 1}, glm::normalize(glm::dvec3(from_x, 0, 1))).total().x;
    };
    const glm::dmat4 behind = glm::rotate(glm::dmat4(1), std::numbers::pi, glm::dvec3(0, 1, 0));
    for (const double from : {1.0, -1.0}) {
        // At a right angle to the light rounding leaves something or nothing.
        const auto approx = [&](glm::dvec3 normal) {
            return Approx(expected(normal, from)).epsilon(1e-6).margin(1e-12);
        };
        CHECK(lit(glm::dmat4(1), from) == approx({lean, rest, lean}));
        CHECK(lit(scaled(-1, 1, 1), from) == approx({-lean, rest, lean}));
        CHECK(lit(scaled(1, -1, 1), from) == approx({lean, -rest, lean}));
        // From behind, turned about y: u runs along −x, and the bump is the other way in.
        CHECK(lit(behind, from) == approx({lean, -rest, lean}));
        // Stretched across: tangents stretch with the surface, then count as unit again.
        CHECK(lit(scaled(3, 1, 0.5), from) == approx({lean, rest, lean}));
    }
    CHECK(lit(glm::dmat4(1), 1) > 10 * lit(glm::dmat4(1), -1));
}

TEST_CASE("reference: second texture coordinates, emission and occlusion", "[cpu]") {
    Scene scene;
    Mesh mesh = quad();
    mesh.uv1 = {{0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}, {0.25f, 0.5f}};  // always the left texel
    const std::uint32_t t = add_texture(scene, 2, 1, point, [](int x, int) {
        return x == 0 ? glm::ivec4(51, 255, 0, 255) : glm::ivec4(255, 0, 0, 255);
    });
    Material m = matte({0.5f, 0.5f, 0.5f});
    m.occlusion_texture = {.texture = t, .uv_set = 1};
    m.occlusion_strength = 0.5f;
    m.emissive = {2, 3, 4};
    m.emissive_texture = {.texture = t};
    add(scene, mesh, m);
    const Picture p = must(render(scene, flat_camera(), {.size = {8, 8}, .ambient = {1, 1, 1}}));
    const double ambient = 0.5 * (1 - 0.5 * 0.8);
    CHECK(p.radiance.texel(1, 3)[0] == Approx(ambient + 2 * linear_of(51)).epsilon(1e-6));
    CHECK(p.radiance.texel(1, 3)[1] == Approx(ambient + 3).epsilon(1e-6));
    CHECK(p.radiance.texel(6, 3)[0] == Approx(ambient + 2).epsilon(1e-6));
    CHECK(p.radiance.texel(6, 3)[1] == Approx(ambient).epsilon(1e-6));
    CHECK(p.radiance.texel(6, 3)[2] == Approx(ambient).epsilon(1e-6));
    // Unlit: neither.
    scene.materials[0].unlit = true;
    CHECK(must(render(scene, flat_camera(), {.size = {8, 8}, .ambient = {1, 1, 1}})).radiance.texel(6, 3)[0] == 0.5f);
}

TEST_CASE("reference: premultiplied radiance is added whole, whatever the alpha", "[cpu]") {
    const glm::dvec3 background{0.25, 0.5, 4};
    const auto draw = [&](const Scene& scene) {
        const Picture p = must(render(scene, flat_camera(), {.size = {4, 4}, .background = background}));
        CHECK(*p.layers.texel(1, 1) == scene.instances.size());
        const float* v = p.radiance.texel(1, 1);
        return glm::dvec3(v[0], v[1], v[2]);
    };
    for (const double alpha : {0.0, 0.25, 1.0}) {
        // Unlit, then emitted: 2, 0.5 and 0.125 of its own, 1 - alpha of what is behind.
        for (const bool unlit : {true, false}) {
            Material m =
                flat({unlit ? 2.0f : 0.0f, unlit ? 0.5f : 0.0f, unlit ? 0.125f : 0.0f, alpha}, AlphaMode::blend);
            m.unlit = unlit;
            if (!unlit) m.emissive = {2, 0.5f, 0.125f};
            m.premultiplied = true;
            CAPTURE(alpha, unlit);
            Scene scene;
            add(scene, quad(), m);
            CHECK(draw(scene) == glm::dvec3(2, 0.5, 0.125) + (1 - alpha) * background);
            // Not premultiplied, the radiance is multiplied by alpha.
            scene.materials[0].premultiplied = false;
            CHECK(draw(scene) == alpha * glm::dvec3(2, 0.5, 0.125) + (1 - alpha) * background);
            // In an opaque material the word means nothing.
            scene.materials[0].premultiplied = true;
            scene.materials[0].alpha_mode = AlphaMode::opaque;
            const Picture p = must(render(scene, flat_camera(), {.size = {4, 4}, .background = background}));
            CHECK(glm::dvec3(p.radiance.texel(1, 1)[0], p.radiance.texel(1, 1)[1], p.radiance.texel(1, 1)[2]) ==
                  glm::dvec3(2, 0.5, 0.125));
        }
    }
}

TEST_CASE("reference: additive light in front of, between and behind glass", "[cpu]") {
    Material light = flat({0.5f, 2, 0.125f, 0}, AlphaMode::blend);
    light.premultiplied = true;
    const Material glass = flat({1, 0.5f, 0.25f, 0.5f}, AlphaMode::blend);
    const glm::dvec3 l(0.5, 2, 0.125), g = 0.5 * glm::dvec3(1, 0.5, 0.25), background(1, 2, 4);
    struct Case {
        std::vector<const Material*> far_to_near;
        glm::dvec3 wanted;
    };
    const Case cases[] = {{{&light}, l + background},
                          {{&light, &light, &light}, 3.0 * l + background},
                          {{&glass, &light}, l + g + 0.5 * background},
                          {{&light, &glass}, g + 0.5 * l + 0.5 * background},
                          {{&glass, &light, &glass}, g + 0.5 * l + 0.5 * g + 0.25 * background}};
    for (const Case& c : cases)
        for (const bool coplanar : {false, true}) {  // then the later one is in front
            Scene scene;
            for (std::size_t i = 0; i < c.far_to_near.size(); ++i)
                add(scene, quad(), *c.far_to_near[i], at(0, 0, coplanar ? 0.0 : static_cast<double>(i)));
            const Picture p = must(render(scene, flat_camera(), {.size = {2, 2}, .background = background}));
            for (int k = 0; k < 3; ++k) CHECK(p.radiance.texel(0, 1)[k] == Approx(c.wanted[k]).epsilon(1e-7));
            const auto fragments =
                must(reference::fragments_at(scene, flat_camera(), {.size = {2, 2}, .background = background}, 0, 1));
            REQUIRE(fragments.size() == c.far_to_near.size());
            for (std::size_t i = 0; i < fragments.size(); ++i) {
                const bool glowing = c.far_to_near[fragments.size() - 1 - i] == &light;
                CHECK(fragments[i].alpha == (glowing ? 0.0 : 0.5));
                CHECK(fragments[i].premultiplied == (glowing ? l : g));
            }
        }
}
