// SPDX-License-Identifier: MIT
// Lights that are set between frames: the picture of a new renderer, bit for bit, nothing built again, and what cannot
// take a light's place is refused with a sentence.
#include <pellucid/rhi/null.hpp>
#include "support/allocations.hpp"
#include "support/shadow_cases.hpp"

using namespace pellucid;

namespace {

/// Spheres, a floor, a pane, and lights of every kind with and without a range, which are stored in another order.
Scene lit_scene() {
    Scene scene = test::varied_scene();
    test::add(scene, make_plane(60, 60), test::matte({0.5f, 0.5f, 0.5f}), test::at(0, -0.6, 0));
    Material glass = test::matte({0.3f, 0.8f, 0.4f}, 0.4f);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    glass.double_sided = true;
    test::add(scene, test::quad(0.7f, 0.5f), glass, test::at(0.4, 0.3, 1));
    scene.lights.push_back(test::torch({-2, 2.1, 0.4}, {0.3, -0.5, 0.1}, 1.3, 3));
    scene.lights.push_back(test::down_light({0.2, 1.4, 0.9}, 2.5f, 0.2, 0.6));
    scene.lights.push_back(test::sun({0.6, -1, 0.1}, 0.4f));
    scene.lights.push_back(test::lamp({1.2, 0.6, 0.8}, 1.5f));
    return scene;
}

/// Everything of them changes that may.
std::vector<Light> moved(std::vector<Light> lights, double by = 1) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light& l = lights[i];
        const double n = by * (1 + 0.1 * static_cast<double>(i));
        l.position += glm::dvec3(0.4, 0.1, -0.3) * n;
        l.direction = glm::normalize(l.direction + glm::dvec3(0.3, 0, 0.2) * n);
        l.color = {l.color.y, l.color.z, l.color.x};
        l.intensity *= 1.25f;
        if (reaches_an_end(l)) l.range *= 1.4f;
        if (l.kind == LightKind::spot) l.inner_cone *= 0.9, l.outer_cone *= 0.95;
    }
    return lights;
}

RenderSettings settings_of(LightAssignment lighting, Shadows shadows) {
    RenderSettings settings = test::shadow_settings(64, 64);
    settings.size = {83, 49};  // no whole number of tiles
    settings.lighting = lighting;
    settings.shadows = shadows;
    return settings;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("lights that are set give the picture of a new renderer", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene before = lit_scene();
    Scene after = before;
    after.lights = moved(before.lights);
    const Camera camera = test::varied_camera();
    for (const Shadows shadows : {Shadows::none, Shadows::map})
        for (const LightAssignment lighting :
             {LightAssignment::loop, LightAssignment::volumes, LightAssignment::tiled, LightAssignment::clustered}) {
            INFO(name(lighting) << ", shadows: " << name(shadows));
            const RenderSettings settings = settings_of(lighting, shadows);
            auto shot = test::shoot<TestType>(*device, before, camera, settings);
            REQUIRE(shot.renderer->stats().lighting == lighting);
            const RenderStats built = shot.renderer->stats();
            test::must(shot.renderer->set_lights(after.lights));
            (void)test::must(shot.renderer->render(camera));
            const ImageF set = test::must(shot.renderer->read_hdr());
            CHECK(test::different_pixels(set, test::shoot<TestType>(*device, after, camera, settings).hdr) == 0);
            CHECK(test::different_pixels(set, shot.hdr) > 1000);
            CHECK(shot.renderer->stats().pipelines == built.pipelines);
            CHECK(shot.renderer->stats().bytes == built.bytes);
            test::must(shot.renderer->set_lights(before.lights));
            (void)test::must(shot.renderer->render(camera));
            CHECK(test::different_pixels(test::must(shot.renderer->read_hdr()), shot.hdr) == 0);
        }
}

TEMPLATE_LIST_TEST_CASE("lights that are set light stored and sorted fragments too, while the camera moves", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = lit_scene();
    RenderSettings settings = settings_of(LightAssignment::clustered, Shadows::map);
    settings.transparency = Transparency::abuffer;
    auto renderer = test::must(Renderer<TestType>::create(*device, scene, settings));
    Camera camera = test::varied_camera();
    for (int frame = 0; frame < 4; ++frame) {
        (void)test::must(renderer->render(camera));  // in flight while the next one is recorded
        scene.lights = moved(scene.lights, frame % 2 == 0 ? 0.3 : -0.2);
        test::must(renderer->set_lights(scene.lights));
        if (frame > 1) camera.world_from_view[3] += glm::dvec4(0.1, 0.05, 0, 0);
        (void)test::must(renderer->render(camera));
        CHECK(test::different_pixels(test::must(renderer->read_hdr()),
                                     test::shoot<TestType>(*device, scene, camera, settings).hdr) == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("shadow maps of lights that moved are drawn again, and no others", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    std::vector<Light> lights = lit_scene().lights;
    auto renderer =
        test::must(Renderer<TestType>::create(*device, lit_scene(), settings_of(LightAssignment::loop, Shadows::map)));
    const auto drawn = [&] {
        test::must(renderer->set_lights(lights));
        (void)test::must(renderer->render(test::varied_camera()));
        return renderer->stats().shadows_drawn;
    };
    (void)drawn();
    CHECK(drawn() == 0);
    for (Light& l : lights) l.intensity *= 2, l.color.x *= 0.5f;
    CHECK(drawn() == 0);  // how bright it is changes no map
    lights[1].position.x += 0.01;
    CHECK(drawn() == PELLUCID_SHADOW_FACES);
    lights[3].outer_cone *= 0.9;
    CHECK(drawn() == 1);
    lights[3].direction = glm::normalize(lights[3].direction + glm::dvec3(0.1, 0, 0));
    CHECK(drawn() == 1);
    lights[0].direction = glm::normalize(lights[0].direction + glm::dvec3(0.1, 0, 0));
    CHECK(drawn() == PELLUCID_SHADOW_CASCADES);
}

TEMPLATE_LIST_TEST_CASE("setting lights and the exposure allocates and creates nothing", "[gpu]", test::Backends) {
    // Validation layers allocate for themselves.
    const auto device = test::make_device<TestType>([](rhi::DeviceDesc& desc) { desc.validation = false; });
    if (!device) return;
    const Scene scene = lit_scene();
    for (const LightAssignment lighting : {LightAssignment::volumes, LightAssignment::clustered}) {
        auto renderer = test::must(Renderer<TestType>::create(*device, scene, settings_of(lighting, Shadows::map)));
        std::vector<Light> lights = scene.lights;
        bool good = true;
        const auto frame = [&] {
            for (Light& l : lights) l.position += glm::dvec3(0.01, 0, 0);
            good = good && renderer->set_lights(lights);
            renderer->set_exposure(renderer->settings().exposure_ev + 0.1f);
            good = good && renderer->render(test::varied_camera());
        };
        for (int i = 0; i < 8; ++i) frame();
        const std::uint64_t allocations = test::allocations();
        const std::uint32_t objects = device->live_objects(), pipelines = renderer->stats().pipelines;
        const std::uint64_t before = test::allocations();
        for (int i = 0; i < 16; ++i) frame();
        const std::uint64_t after = test::allocations();
        INFO(name(lighting));
        CHECK(good);
        CHECK(before > allocations);  // the stats allocate: they are counted
        CHECK(after - before == 0);
        CHECK(device->live_objects() == objects);
        CHECK(renderer->stats().pipelines == pipelines);
    }
}

TEMPLATE_LIST_TEST_CASE("an exposure that is set gives the picture of a new renderer", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    RenderSettings settings = settings_of(LightAssignment::loop, Shadows::none);
    auto shot = test::shoot<TestType>(*device, lit_scene(), test::varied_camera(), settings);
    const Image8 dark = test::must(shot.renderer->read_display());
    settings.exposure_ev = 1.5f;
    shot.renderer->set_exposure(1.5f);
    CHECK(shot.renderer->settings().exposure_ev == 1.5f);
    (void)test::must(shot.renderer->render(test::varied_camera()));
    const Image8 bright = test::must(shot.renderer->read_display());
    CHECK(test::different_pixels(test::must(shot.renderer->read_hdr()), shot.hdr) == 0);
    CHECK(bright.data != dark.data);
    auto fresh = test::shoot<TestType>(*device, lit_scene(), test::varied_camera(), settings);
    CHECK(bright.data == test::must(fresh.renderer->read_display()).data);
}

TEMPLATE_LIST_TEST_CASE("lights that are refused change nothing", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    auto shot = test::shoot<TestType>(*device, lit_scene(), test::varied_camera(),
                                      settings_of(LightAssignment::volumes, Shadows::map));
    std::vector<Light> lights = moved(lit_scene().lights);
    lights.back().kind = LightKind::spot;
    REQUIRE_FALSE(shot.renderer->set_lights(lights));
    (void)test::must(shot.renderer->render(test::varied_camera()));
    CHECK(test::different_pixels(test::must(shot.renderer->read_hdr()), shot.hdr) == 0);
    CHECK(shot.renderer->stats().shadows_drawn == 0);
}

TEST_CASE("lights that cannot take the place of a scene's are refused, and a sentence says which and why", "[cpu]") {
    null::Device device;
    const Scene scene = lit_scene();
    const auto refusal = [&](Shadows shadows, auto&& change) {
        auto renderer = test::must(Renderer<Null>::create(device, scene, settings_of(LightAssignment::loop, shadows)));
        std::vector<Light> lights = scene.lights;
        change(lights);
        const Result<void> set = renderer->set_lights(lights);
        if (set) return std::string("taken");
        CHECK(set.error().code == Errc::invalid_argument);
        return set.error().message;
    };
    const auto none = Shadows::none, map = Shadows::map;
    using Lights = std::vector<Light>;
    CHECK(refusal(none, [](Lights& l) { l.pop_back(); }) ==
          "7 lights cannot take the place of 8: keep their number, or create a renderer for these lights");
    CHECK(refusal(none, [](Lights& l) { l[2].intensity = -1; }) ==
          "light 2 (\"\"): its intensity is -1, but must be finite and at least 0");
    CHECK(refusal(none, [](Lights& l) { l[1].kind = LightKind::directional, l[1].name = "lamp"; }) ==
          "light 1 (\"lamp\") is directional, and the renderer was built for one that is a point light: keep it so, or "
          "create a renderer for these lights");
    CHECK(refusal(none, [](Lights& l) { std::swap(l[2], l[3]); }) ==
          "light 2 (\"\") is a spot light, and the renderer was built for one that is a point light: keep it so, or "
          "create a renderer for these lights");
    CHECK(refusal(none, [](Lights& l) { l[2].range = 0; }) ==
          "light 2 (\"\") has no range, and the renderer was built for one that ends at a range: keep it so, or create "
          "a renderer for these lights");
    CHECK(refusal(map, [](Lights& l) { l[7].shadows = false; }) ==
          "light 7 (\"\") casts no shadows, and the renderer was built for one that casts shadows by 6 maps: keep it "
          "so, or create a renderer for these lights");
    CHECK(refusal(map, [](Lights& l) { l[3].outer_cone = 1.2; }) ==
          "light 3 (\"\") casts shadows by 6 maps, and the renderer was built for one that casts shadows by 1 map: "
          "keep it so, or create a renderer for these lights");
    // Without shadow maps there is nothing to keep of them.
    CHECK(refusal(none, [](Lights& l) { l[7].shadows = false, l[3].outer_cone = 1.2; }) == "taken");
    CHECK(refusal(map, [](Lights& l) { l = moved(l), l[0].range = 5; }) == "taken");
}

TEST_CASE("a scene without lights takes none, and keeps its sun", "[cpu]") {
    null::Device device;
    Scene scene = lit_scene();
    scene.lights.clear();
    auto renderer = test::must(Renderer<Null>::create(device, scene, {.size = {16, 16}}));
    CHECK(renderer->set_lights({}));
    const Light light;
    CHECK_FALSE(renderer->set_lights({&light, 1}));
    CHECK(renderer->stats().lights == 1);
}
