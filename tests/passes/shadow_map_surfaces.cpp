// SPDX-License-Identifier: MIT
// What shadows fall on, and what casts them: facets with smooth normals, normal maps, holes, translucent and unlit
// surfaces.
#include <cstdio>
#include "support/shadow_cases.hpp"

using namespace pellucid;
using test::add;

namespace {

/// Pixels that are darker than without shadows, among those where `light_at(x, y)` asks for them not to be.
template <rhi::Backend B, class Asked>
std::size_t darker(const test::ShadowPair<B>& pair, Asked&& asked) {
    const std::vector<double> share = pair.share();
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < pair.with.hdr.height; ++y)
        for (std::uint32_t x = 0; x < pair.with.hdr.width; ++x)
            count += share[std::size_t{y} * pair.with.hdr.width + x] < 1 && asked(x, y);
    return count;
}

/// A picture of 64×64 normals that lean by up to 40° every way.
Image8 bumps() {
    Image8 image(64, 64, 4);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
            const double a = 0.6 * std::sin(x * 0.39), b = 0.6 * std::sin(y * 0.39 + 1);
            const glm::dvec3 n = glm::normalize(glm::dvec3(a, b, 1));
            for (int c = 0; c < 3; ++c)
                image.texel(x, y)[c] = static_cast<std::uint8_t>(std::lround(127.5 * (n[c] + 1)));
            image.texel(x, y)[3] = 255;
        }
    return image;
}

/// Light and dark squares of the mask: 4×4 texels, every other one a hole.
Image8 holes() {
    Image8 image(4, 4, 4);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 4; ++x) {
            std::fill_n(image.texel(x, y), 3, std::uint8_t{255});
            image.texel(x, y)[3] = (x + y) % 2 == 0 ? 255 : 0;
        }
    return image;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a ball of flat facets with smooth normals does not shadow its lit side", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    for (const std::uint32_t maps : {64u, 512u}) {
        Scene scene;
        add(scene, make_uv_sphere(1, 24, 48), test::matte({0.8f, 0.8f, 0.8f}));
        const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.6, 0.5, 0.7));
        const Camera camera{.projection = Projection::orthographic,
                            .half_width = 1.1,
                            .half_height = 1.1,
                            .near = 1,
                            .far = 20,
                            .world_from_view = test::at(0, 0, 10)};
        for (const Light& light :
             {test::sun(-to_light), test::bulb(4.0 * to_light), test::torch(4.0 * to_light, {0, 0, 0}, 0.4)}) {
            scene.lights = {light};
            const auto pair = test::shadow_pair<TestType>(*device, scene, camera, test::shadow_settings(maps, 128));
            const std::size_t wrong = darker(pair, [&](std::uint32_t x, std::uint32_t y) {
                const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / 64.0 - 1.0;
                const glm::dvec2 p(1.1 * at.x, -1.1 * at.y);
                if (glm::length(p) > 0.97) return false;
                const glm::dvec3 n(p, std::sqrt(1 - glm::dot(p, p)));
                const glm::dvec3 l =
                    light.kind == LightKind::directional ? to_light : glm::normalize(4.0 * to_light - n);
                return glm::dot(n, l) > 0.17;  // up to 80°; a facet leans by 4° more
            });
            INFO("light " << static_cast<int>(light.kind) << ", maps of " << maps);
            CHECK(wrong == 0);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("a normal map turns light, not the plane that shadows fall on", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    scene.images.push_back({bumps(), "bumps"});
    scene.textures.push_back({.image = 0});
    Material bumpy = test::matte({0.8f, 0.8f, 0.8f});
    bumpy.normal_texture.texture = 0;
    Mesh floor = make_plane(4, 4, 4);
    floor.tangents.assign(floor.positions.size(), {1, 0, 0, 1});
    add(scene, floor, bumpy);
    const Camera camera{.vertical_fov = 0.9, .near = 0.1, .world_from_view = look_at({0.5, 2, 3}, {0, 0, 0})};
    for (const double height : {1.0, 0.3, 0.1}) {
        scene.lights = {test::sun({1, -height, 0.3})};
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment})
            for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic}) {
                RenderSettings settings = test::shadow_settings(256, 96);
                settings.shading = stage;
                settings.gbuffer = layout;
                const auto pair = test::shadow_pair<TestType>(*device, scene, camera, settings);
                // A pixel that has no neighbour in its row, or none in its column, has no plane but its normal's.
                const auto seen = [&](std::uint32_t x, std::uint32_t y) {
                    return x < 96 && y < 96 && pair.without.hdr.texel(x, y)[1] > 0;
                };
                const std::size_t wrong = darker(pair, [&](std::uint32_t x, std::uint32_t y) {
                    return (seen(x + 1, y) || seen(x - 1, y)) && (seen(x, y + 1) || seen(x, y - 1));
                });
                INFO("a sun of height " << height << ", " << name(stage) << ", " << name(layout));
                CHECK(wrong == 0);
                CHECK(pair.changed() <= 2);
            }
    }
}

TEMPLATE_LIST_TEST_CASE("a masked surface casts its holes", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    test::add_floor(scene, 4);
    scene.images.push_back({holes(), "holes"});
    scene.textures.push_back(
        {.image = 0, .sampler = {.min = TextureFilter::nearest, .mag = TextureFilter::nearest, .mipmapped = false}});
    Material fence = test::matte({0.5f, 0.5f, 0.5f});
    fence.alpha_mode = AlphaMode::mask;
    fence.base_color_texture.texture = 0;
    test::add_sheet(scene, {0, 1, 0}, 1, fence);
    scene.lights = {test::sun({2.2, -1, 0})};  // the shadow lies beside the sheet: from 1.2 to 3.2 along x
    constexpr std::uint32_t pixels = 96;
    const glm::dvec3 middle(2.2, 0, 0);
    const auto pair = test::shadow_pair<TestType>(*device, scene, test::plan_camera(middle, 1.1),
                                                  test::shadow_settings(1024, pixels));
    const std::vector<double> share = pair.share();
    std::size_t dark = 0, lit = 0, wrong = 0;
    for (std::uint32_t y = 0; y < pixels; ++y)
        for (std::uint32_t x = 0; x < pixels; ++x) {
            // uv of the sheet that the light comes through: v runs down the picture, towards +z.
            const glm::dvec3 p = test::plan_point(middle, 1.1, pixels, x, y);
            const glm::dvec2 uv = (glm::dvec2(p.x - 2.2, p.z) + 1.0) * 2.0;  // [texel]
            const glm::dvec2 within = uv - glm::floor(uv);
            if (uv.x < 0.2 || uv.y < 0.2 || uv.x > 3.8 || uv.y > 3.8) continue;
            if (std::min(within.x, within.y) < 0.2 || std::max(within.x, within.y) > 0.8) continue;
            const bool hole = (static_cast<int>(uv.x) + static_cast<int>(uv.y)) % 2 != 0;
            const double s = share[std::size_t{y} * pixels + x];
            (hole ? lit : dark) += 1;
            wrong += hole ? s != 1 : s != 0;
        }
    CHECK(lit > 300);
    CHECK(dark > 300);
    CHECK(wrong == 0);
}

TEMPLATE_LIST_TEST_CASE("shadows fall on translucent surfaces, which cast none", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    Material glass = test::matte({0.3f, 0.8f, 0.4f});
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.5f;
    test::add_sheet(scene, {0, 0.5, 0}, 2, glass);
    test::add_sheet(scene, {-1, 1.5, 0}, 0.5f);
    scene.lights = {test::sun({1, -1, 0})};  // on the glass from -0.5 to 0.5
    constexpr std::uint32_t pixels = 64;
    for (const Transparency method : {Transparency::sorted, Transparency::abuffer, Transparency::peel,
                                      Transparency::interleaved, Transparency::dual_peel})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            if (stage == ShadingStage::fragment && method != Transparency::abuffer) continue;
            RenderSettings settings = test::shadow_settings(256, pixels);
            settings.transparency = method;
            settings.shading = stage;
            const auto pair = test::shadow_pair<TestType>(*device, scene, test::plan_camera({0, 0, 0}, 1.8), settings);
            const std::vector<double> share = pair.share();
            std::size_t dark = 0, wrong = 0;
            for (std::uint32_t y = 0; y < pixels; ++y)
                for (std::uint32_t x = 0; x < pixels; ++x) {
                    const glm::dvec3 p = test::plan_point({0, 0, 0}, 1.8, pixels, x, y);
                    const double s = share[std::size_t{y} * pixels + x];
                    if (p.x < -0.45) continue;  // the sheet that casts
                    const double off = std::max(std::abs(p.x), std::abs(p.z));
                    dark += off < 0.4;
                    wrong += (off < 0.4 && s != 0) || (off > 0.6 && s != 1);
                }
            INFO(name(method) << ", " << name(stage));
            CHECK(dark > 100);
            CHECK(wrong == 0);
        }
    // The floor under the glass is lit as if it were not there.
    Scene under = scene;
    under.instances.erase(under.instances.begin() + 1);
    test::add_floor(under, 3);
    const auto pair =
        test::shadow_pair<TestType>(*device, under, test::plan_camera({0, 0, 0}, 1.8), test::shadow_settings(128));
    REQUIRE(pair.with.renderer->stats().shadows == Shadows::map);
    CHECK(pair.changed() == 0);
}

TEMPLATE_LIST_TEST_CASE("unlit surfaces cast, and nothing falls on them", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    add(scene, make_plane(2, 6), test::flat({0.4f, 0.5f, 0.6f, 1}), test::at(-1, 0, 0));
    add(scene, make_plane(2, 6), test::matte({0.8f, 0.8f, 0.8f}), test::at(1, 0, 0));
    test::add_sheet(scene, {0, 1, 0}, 0.5f, test::flat({1, 1, 1, 1}));
    scene.lights = {test::sun({0, -1, 1})};
    constexpr std::uint32_t pixels = 64;
    const auto pair = test::shadow_pair<TestType>(*device, scene, test::plan_camera({0, 0, 0}, 2),
                                                  test::shadow_settings(128, pixels));
    std::size_t left = 0, right = 0;
    for (std::uint32_t y = 0; y < pixels; ++y)
        for (std::uint32_t x = 0; x < pixels; ++x) {
            const bool same = std::memcmp(pair.with.hdr.texel(x, y), pair.without.hdr.texel(x, y), 16) == 0;
            (x < pixels / 2 ? left : right) += !same;
        }
    CHECK(left == 0);
    CHECK(right > 50);
}
