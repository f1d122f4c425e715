// SPDX-License-Identifier: MIT
// Shadow maps from frame to frame and from setting to setting: the same bits whatever finds the lights and whichever
// API draws, maps drawn again only where they changed, and what is refused.
#include <pellucid/rhi/null.hpp>
#include "support/shadow_cases.hpp"

using namespace pellucid;
using test::add;

namespace {

/// Spheres, a floor, a pane and a light of every kind that casts.
Scene shadowed_scene() {
    Scene scene = test::varied_scene();
    Material glass = test::matte({0.3f, 0.8f, 0.4f}, 0.4f);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    glass.double_sided = true;
    add(scene, test::quad(0.7f, 0.5f), glass, test::at(0.4, 0.3, 1));
    scene.lights.push_back(test::torch({-2, 2.1, 0.4}, {0.3, -0.5, 0.1}, 1.3, 3));  // six maps
    return scene;
}

RenderSettings settings_of(LightAssignment lighting, Transparency transparency = Transparency::sorted) {
    RenderSettings settings = test::shadow_settings(128, 48);
    settings.lighting = lighting;
    settings.transparency = transparency;
    return settings;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lists of lights give the loop's bits with shadows too, and volumes its values", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = shadowed_scene();
    for (const Transparency transparency : {Transparency::sorted, Transparency::abuffer}) {
        const auto shot = [&](LightAssignment lighting) {
            return test::shoot<TestType>(*device, scene, test::varied_camera(), settings_of(lighting, transparency));
        };
        const auto loop = shot(LightAssignment::loop);
        RenderSettings plain = settings_of(LightAssignment::loop, transparency);
        plain.shadows = Shadows::none;
        CHECK(test::different_pixels(loop.hdr,
                                     test::shoot<TestType>(*device, scene, test::varied_camera(), plain).hdr) > 200);
        for (const LightAssignment lighting : {LightAssignment::tiled, LightAssignment::clustered}) {
            const auto lists = shot(lighting);
            INFO(name(transparency) << ", " << name(lighting));
            REQUIRE(lists.renderer->stats().lighting == lighting);
            CHECK(test::different_pixels(loop.hdr, lists.hdr) == 0);
        }
        const auto volumes = shot(LightAssignment::volumes);
        for (std::size_t i = 0; i < loop.hdr.data.size(); ++i)
            CHECK(std::abs(loop.hdr.data[i] - volumes.hdr.data[i]) <= 3 * 0x1p-10f * (0.01f + loop.hdr.data[i]));
    }
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("maps and pictures have the same bits on both APIs", "[gpu]") {
    const auto vulkan = test::make_device<Vulkan>();
    const auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    const Scene scene = shadowed_scene();
    for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
        RenderSettings settings = settings_of(LightAssignment::loop, Transparency::abuffer);
        settings.size = {128, 96};
        settings.shading = stage;
        const auto a = test::shoot<Vulkan>(*vulkan, scene, test::varied_camera(), settings);
        const auto b = test::shoot<OpenGL>(*opengl, scene, test::varied_camera(), settings);
        std::size_t maps = 0;
        for (std::uint32_t layer = 0; layer < a.renderer->stats().shadow_maps; ++layer)
            if (layer == 0 || layer >= PELLUCID_SHADOW_CASCADES)  // the scene is in one cascade
                maps += test::must(a.renderer->read_shadow_map(layer)).bytes !=
                        test::must(b.renderer->read_shadow_map(layer)).bytes;
        CHECK(maps == 0);
        CHECK(test::different_pixels(a.hdr, b.hdr) == 0);
    }
}
#endif

TEMPLATE_LIST_TEST_CASE("where nothing casts, the picture is that without shadows, and the stats say why", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene;
    Material glass = test::matte({0.3f, 0.8f, 0.4f});
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    test::add_sheet(scene, {0, 1, 0}, 1, glass);
    test::add_sheet(scene, {0, 0, 0}, 2, glass);
    scene.lights = {test::sun({0.3, -1, 0}), test::bulb({1, 3, 0})};
    const auto pair =
        test::shadow_pair<TestType>(*device, scene, test::plan_camera({0, 0, 0}, 2), test::shadow_settings(64));
    CHECK(pair.changed() == 0);
    const RenderStats stats = pair.with.renderer->stats();
    CHECK(stats.shadows == Shadows::none);
    CHECK(stats.shadows_why == "no opaque surface casts a shadow");
    CHECK(stats.shadow_maps == 0);
    CHECK(stats.pipelines == pair.without.renderer->stats().pipelines);
    CHECK(stats.bytes == pair.without.renderer->stats().bytes);
    bool said = false;
    for (const PassReport& pass : stats.passes)
        if (std::string(pass.name) == "shadow_map") said = !pass.ran && pass.reason == stats.shadows_why;
    CHECK(said);
}

TEMPLATE_LIST_TEST_CASE("maps are drawn again where they changed, and only there", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = shadowed_scene();
    add(scene, make_plane(200, 200), test::matte({0.5f, 0.5f, 0.5f}), test::at(0, -0.6, 0));  // so there are cascades
    auto renderer = test::must(
        Renderer<TestType>::create(*device, scene, settings_of(LightAssignment::loop, Transparency::sorted)));
    const auto frame = [&](const Camera& camera) {
        (void)test::must(renderer->render(camera));
        const ImageF hdr = test::must(renderer->read_hdr());
        // The same as a renderer that knows no frame before.
        const ImageF fresh = test::shoot<TestType>(*device, scene, camera, renderer->settings()).hdr;
        CHECK(test::different_pixels(hdr, fresh) == 0);
        return renderer->stats().shadows_drawn;
    };
    Camera camera = test::varied_camera();
    const std::uint32_t suns = 1, placed = 2 * 6 + 1 + 6;
    REQUIRE(renderer->stats().shadow_maps == suns * PELLUCID_SHADOW_CASCADES + placed);
    CHECK(frame(camera) == PELLUCID_SHADOW_CASCADES + placed);
    CHECK(frame(camera) == 0);
    camera.world_from_view[3] += glm::dvec4(1e-5, 2e-5, -1e-5, 0);  // far less than a texel
    CHECK(frame(camera) == 0);
    camera.world_from_view[3] += glm::dvec4(3, 1, 2, 0);
    const std::uint32_t drawn = frame(camera);
    CHECK(drawn > 0);
    CHECK(drawn <= PELLUCID_SHADOW_CASCADES);
}

TEST_CASE("shadows that a device cannot hold are refused before anything is made", "[cpu]") {
    Scene scene;
    test::add_floor(scene, 1);
    const auto refusal = [&](std::uint32_t lights, std::uint32_t size, Errc code) {
        null::Device device;
        scene.lights.assign(lights, test::bulb({0, 1, 0}));
        RenderSettings settings = test::shadow_settings(size, 16);
        const auto made = Renderer<Null>::create(device, scene, settings);
        REQUIRE_FALSE(made);
        CHECK(made.error().code == code);
        CHECK(device.calls().empty());
        return made.error().message;
    };
    for (const std::uint32_t size : {0u, 15u, 16385u, ~0u})
        CHECK(refusal(1, size, Errc::invalid_argument) ==
              "a shadow map's size is " + std::to_string(size) + "; each side must be 16 to 16384 texels on null");
    CHECK(refusal(342, 16, Errc::unsupported) ==
          "the shadows of 342 lights take 2052 maps of 16x16 texels, 2101248 bytes; null has room for 2048 maps in an "
          "array: let fewer lights cast (Light::shadows)");
    CHECK(refusal(100, 1024, Errc::invalid_argument) ==
          "the shadows of 100 lights take 600 maps of 1024x1024 texels, 2516582400 bytes; the limit is 2147483648 "
          "bytes: ask for a smaller --shadow-size, or let fewer lights cast (Light::shadows)");
    // What casts nothing takes nothing.
    null::Device device;
    for (Light& light : scene.lights) light.shadows = false;
    const auto made = Renderer<Null>::create(device, scene, test::shadow_settings(1024, 16));
    REQUIRE(made);
    CHECK((*made)->stats().shadows_why == "no light casts shadows");
    for (Material& m : scene.materials) m.unlit = true;
    for (Light& light : scene.lights) light.shadows = true;
    CHECK(scene_needs(scene, test::shadow_settings(16)).shadows_why == "no light falls on any surface");
}

TEST_CASE("whatever fails while shadows are made or drawn, the error comes out and nothing is left", "[cpu]") {
    const Scene scene = shadowed_scene();
    std::uint64_t n = 1;
    for (; n < 300; ++n) {
        null::Device device;
        device.fail_after(n);
        auto made = Renderer<Null>::create(device, scene, test::shadow_settings(64, 16));
        if (made) {
            const auto frame = (*made)->render(test::varied_camera());
            if (frame) break;
            CHECK(frame.error().code == Errc::out_of_memory);
            CHECK((*made)->render(test::varied_camera()));  // the next one works
        } else {
            CHECK(made.error().code == Errc::out_of_memory);
            CHECK(device.live_objects() == 0);
        }
    }
    CHECK(n > 40);
    CHECK(n < 300);
}
