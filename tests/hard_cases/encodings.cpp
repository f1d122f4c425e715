// SPDX-License-Identifier: MIT
// What the G-buffer keeps of roughness and colour, to the last code, and of normals that are none.
#include <algorithm>
#include <encodings/scalars.hpp>
#include <limits>
#include <numbers>
#include <set>
#include "hard_cases/lit_pixels.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {
constexpr double pi = std::numbers::pi;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// 256 tiles of 4 × 4 pixels: the code of a driver's sRGB value in red, the other way round in green.
glm::vec3 color_of(std::uint32_t k) {
    const auto linear = [](std::uint32_t code) {
        return reference::linear_from_srgb8<float>(static_cast<std::uint8_t>(code));
    };
    return {linear(k), linear(255 - k), linear(k * 37 % 256)};
}
/// Codes of tile `k` in a picture of 64 × 64 pixels.
bool is_code_of(const std::uint8_t* t, std::uint32_t k) {
    return t[0] == k && t[1] == 255 - k && t[2] == k * 37 % 256;
}
}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: a ramp of roughness from 0.045 to 0.2 in highlights", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    constexpr std::uint32_t n = 128;
    const auto roughness = [](std::uint32_t x) { return 0.046 + 0.154 * x / (n - 1); };
    Scene scene;
    for (std::uint32_t x = 0; x < n; ++x)
        add(scene, quad(1.0f / n, 1),
            {.base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = static_cast<float>(roughness(x))},
            at((2.0 * x + 1) / n - 1, 0, 0));
    scene.lights = {sun_in_the_eye()};
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic}) {
        RenderSettings settings = settings_for(n);
        settings.gbuffer = layout;
        const auto shot = shoot<TestType>(*device, scene, flat_camera(), settings);
        double off = 0;
        std::set<float> values;
        float last = std::numeric_limits<float>::max();
        for (std::uint32_t x = 0; x < n; ++x) {
            const float got = shot.hdr.texel(x, n / 2)[0];
            const double peak = 1 / (4 * pi * std::pow(roughness(x), 4));
            off = std::max(off, std::abs(got / peak - 1));
            CHECK(got <= last);
            last = got;
            values.insert(got);
        }
        std::printf("%s %s: peaks off by up to %.3g, %zu of %u values\n", TestType::name, name(layout), off,
                    values.size(), n);
        if (layout == GBufferLayout::compact) {
            CHECK(off <= 2e-3);
            CHECK(values.size() == n);
        } else {  // 8 bits
            CHECK(off > 0.08);
            CHECK(values.size() <= 41);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: all 256 sRGB codes through the G-buffer and to the display", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    RenderSettings settings = settings_for(64);
    settings.tonemap = ToneCurve::none;
    // Base colour as a factor, as a texel, and shown as it is.
    Image8 texels(16, 16, 4);
    for (std::uint32_t k = 0; k < 256; ++k) {
        std::uint8_t* const t = texels.texel(k % 16, k / 16);
        t[0] = static_cast<std::uint8_t>(k);
        t[1] = static_cast<std::uint8_t>(255 - k);
        t[2] = static_cast<std::uint8_t>(k * 37 % 256);
        t[3] = 255;
    }
    Scene textured;
    textured.images.push_back({texels, "codes"});
    textured.textures.push_back(
        {.image = 0, .sampler = {.min = TextureFilter::nearest, .mag = TextureFilter::nearest, .mipmapped = false}});
    Material m = matte({1, 1, 1});
    m.base_color_texture.texture = 0;
    add(textured, quad(), m);
    const Scene factors = material_tiles(16, [](std::uint32_t k) { return matte(color_of(k)); });
    for (const Scene* scene : {&factors, &std::as_const(textured)}) {
        const auto codes = shoot<TestType>(*device, *scene, flat_camera(), settings).compact();
        std::size_t other = 0;
        for (std::uint32_t i = 0; i < 64 * 64; ++i) {
            const std::uint32_t c = codes[i].color;
            const std::uint8_t rgb[] = {static_cast<std::uint8_t>(c), static_cast<std::uint8_t>(c >> 8u),
                                        static_cast<std::uint8_t>(c >> 16u)};
            other += !is_code_of(rgb, i / 64 / 4 * 16 + i % 64 / 4);
        }
        INFO((scene == &factors ? "factors" : "texels"));
        CHECK(other == 0);
    }
    settings.keep_gbuffer = false;
    Scene unlit_texels = textured;
    unlit_texels.materials[0].unlit = true;
    const Scene unlit_factors = material_tiles(16, [](std::uint32_t k) { return flat(glm::vec4(color_of(k), 1)); });
    for (const Scene* scene : {&unlit_factors, &std::as_const(unlit_texels)}) {
        auto shot = shoot<TestType>(*device, *scene, flat_camera(), settings);
        const Image8 display = must(shot.renderer->read_display());
        std::size_t other = 0;
        for (std::uint32_t i = 0; i < 64 * 64; ++i)
            other += !is_code_of(display.texel(i % 64, i / 64), i / 64 / 4 * 16 + i % 64 / 4);
        INFO((scene == &unlit_factors ? "factors" : "texels"));
        CHECK(other == 0);
    }
    // A power of 2.2 in place of the curve: most codes come out as others.
    std::size_t changed = 0;
    for (std::uint32_t k = 0; k < 256; ++k)
        changed += bench::encode_color(bench::ColorForm::gamma, double{color_of(k).r}) != k;
    CHECK(changed > 128);
}

TEMPLATE_LIST_TEST_CASE("hard cases: normals and tangents that are none", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::vec3 z(0, 0, 1), slant = glm::normalize(glm::vec3(0.3f, -0.2f, 0.9f));
    struct Case {
        const char* what;
        glm::vec3 normal;
        glm::vec4 tangent;
        glm::vec3 wanted;  ///< direction, where it is known
    };
    const Case cases[] = {
        {"tangent of length 0", slant, {0, 0, 0, 1}, slant},
        {"tangent of length 0, w 0", slant, {0, 0, 0, 0}, slant},
        {"tangent along the normal", slant, {slant, 1}, slant},
        {"tangent that is NaN", slant, {not_a_number, not_a_number, not_a_number, 1}, slant},
        {"tangent against the normal", slant, {-slant, 1}, slant},
        {"w that is NaN", slant, {1, 0, 0, not_a_number}, slant},
        {"normal of length 0", {0, 0, 0}, {0, 0, 0, 1}, z},
        {"normal that is NaN", {not_a_number, not_a_number, not_a_number}, {1, 0, 0, 1}, z},
        {"normal of length 1e-3", slant * 1e-3f, {0, 0, 0, 1}, slant},
        {"normal of length 1e3", slant * 1e3f, {0, 0, 0, 1}, slant},
        {"normal of length 1e-18", slant * 1e-18f, {0, 0, 0, 1}, slant},
        {"normal of length 1e18", slant * 1e18f, {0, 0, 0, 1}, slant},
    };
    Image8 lean(1, 1, 4);  // a normal map that leans by half a right angle
    lean.data = {218, 128, 218, 255};
    Scene scene;
    scene.images.push_back({lean, "lean"});
    scene.textures.push_back({.image = 0});
    constexpr std::uint32_t n = 16;
    for (std::uint32_t i = 0; i < std::size(cases); ++i) {
        Mesh mesh = quad(1.0f / n, 1);
        mesh.normals.assign(4, cases[i].normal);
        mesh.tangents.assign(4, cases[i].tangent);
        Material m = matte({1, 1, 1}, 0.3f);
        m.normal_texture.texture = 0;
        add(scene, mesh, m, at((2.0 * i + 1) / n - 1, 0, 0));
    }
    scene.lights = {{.kind = LightKind::directional, .direction = glm::normalize(glm::dvec3(-0.3, -0.4, -1))}};
    const auto shot = shoot<TestType>(*device, scene, flat_camera(), settings_for(n));
    const auto texels = shot.compact();
    for (std::uint32_t i = 0; i < std::size(cases); ++i) {
        INFO(cases[i].what);
        const reference::CompactTexel& t = texels[n / 2 * n + i];
        REQUIRE(t.depth != 0);
        const glm::dvec3 normal = reference::direction_from_oct32<double>(t.normal);
        INFO(normal.x << " " << normal.y << " " << normal.z);
        CHECK(glm::dot(normal, glm::dvec3(cases[i].wanted)) > std::cos(0.005 * pi / 180));
        for (std::uint32_t c = 0; c < 3; ++c) {
            CHECK(std::isfinite(shot.hdr.texel(i, n / 2)[c]));
            CHECK(shot.hdr.texel(i, n / 2)[c] > 0);
        }
    }
    CHECK(std::isnan(glm::normalize(glm::vec3(0)).x));
}
