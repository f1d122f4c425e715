// SPDX-License-Identifier: MIT
// Whatever fails while a renderer is made or a frame is recorded, an error comes out and nothing is left behind.
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/rhi/null.hpp>
#include "support/catch.hpp"
#include "support/scene.hpp"

using namespace pellucid;
using test::add;

namespace {
/// Opaque, double-sided, mirrored, emissive, textured and translucent: every pass and every kind of object.
Scene full_scene() {
    Scene scene = test::varied_scene();
    scene.images.push_back({Image8(4, 4, 4), "picture"});
    scene.textures.push_back({.image = 0});
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].normal_texture.texture = 0;
    scene.materials[1].emissive = {1, 1, 1};
    scene.materials[2].double_sided = true;
    Material glass = test::matte({1, 1, 1});
    glass.alpha_mode = AlphaMode::blend;
    glass.double_sided = true;
    add(scene, test::quad(), glass, test::scaled(-1, 1, 1));
    return scene;
}
}  // namespace

TEST_CASE("every creation that can fail: the error comes out and every object is gone", "[cpu]") {
    const Scene scene = full_scene();
    for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
        RenderSettings settings = test::settings_for(16);
        settings.shading = stage;
        std::uint64_t n = 1;
        for (; n < 200; ++n) {
            null::Device device;
            device.fail_after(n);
            const auto made = Renderer<Null>::create(device, scene, settings);
            if (made) break;
            INFO("creation " << n << ": " << made.error().message);
            REQUIRE(made.error().code == Errc::out_of_memory);
            REQUIRE_FALSE(made.error().message.empty());
            REQUIRE(device.live_objects() == 0);
        }
        CHECK(n > 20);
        CHECK(n < 200);
    }
}

TEST_CASE("a renderer leaves nothing behind when it goes", "[cpu]") {
    null::Device device;
    {
        const auto renderer = test::must(Renderer<Null>::create(device, full_scene(), test::settings_for(16)));
        CHECK(device.live_objects() > 20);
        for (int i = 0; i < 3; ++i) (void)test::must(renderer->render({}));
        const std::uint32_t live = device.live_objects();
        (void)test::must(renderer->render({}));
        CHECK(device.live_objects() == live);
    }
    CHECK(device.live_objects() == 0);
}

TEST_CASE("a lost device, and rings that cannot grow, are errors of the frame", "[cpu]") {
    null::Device device;
    const auto renderer = test::must(Renderer<Null>::create(device, full_scene(), test::settings_for(16)));
    for (std::uint64_t n = 1; n <= 2; ++n) {  // uniforms, records
        device.fail_after(n);
        const auto failed = renderer->render({});
        REQUIRE_FALSE(failed);
        CHECK(failed.error().code == Errc::out_of_memory);
    }
    device.fail_after(0);
    CHECK(renderer->render({}));
    device.lose();
    const auto lost = renderer->render({});
    REQUIRE_FALSE(lost);
    CHECK(lost.error().code == Errc::device_lost);
}

TEST_CASE("sizes that no device has are refused with the limit", "[cpu]") {
    null::Device device;
    for (const Extent2D size :
         {Extent2D{0, 16}, Extent2D{16, 0}, Extent2D{0, 0}, Extent2D{~0u, 16}, Extent2D{16, ~0u}}) {
        const auto made = Renderer<Null>::create(device, full_scene(), {.size = size});
        INFO(size.width << "x" << size.height);
        REQUIRE_FALSE(made);
        CHECK(made.error().code == Errc::invalid_argument);
        CHECK(made.error().message.find(std::to_string(size.width) + "x" + std::to_string(size.height)) !=
              std::string::npos);
        CHECK(made.error().message.find("each side must be 1 to") != std::string::npos);
        CHECK(device.live_objects() == 0);
    }
}

TEST_CASE("a scene with a light that cannot be is refused before anything is made", "[cpu]") {
    null::Device device;
    Scene scene = full_scene();
    scene.lights.push_back({.kind = LightKind::spot, .inner_cone = 0.5, .outer_cone = 0.25, .name = "swapped"});
    const auto made = Renderer<Null>::create(device, scene, test::settings_for(16));
    REQUIRE_FALSE(made);
    CHECK(made.error().code == Errc::invalid_argument);
    CHECK(made.error().message ==
          "light " + std::to_string(scene.lights.size() - 1) +
              " (\"swapped\"): its inner cone is 0.5, but must be at least 0 and below its outer "
              "cone, 0.25 rad");
    CHECK(device.live_objects() == 0);
}

TEST_CASE("a G-buffer is read only where it was kept, and only as many targets as there are", "[cpu]") {
    null::Device device;
    RenderSettings settings = test::settings_for(16);
    auto kept = test::must(Renderer<Null>::create(device, full_scene(), settings));
    (void)test::must(kept->render({}));
    CHECK(kept->read_gbuffer(3));  // emissive
    CHECK(kept->read_gbuffer(Renderer<Null>::depth_index));
    const auto beyond = kept->read_gbuffer(4);
    REQUIRE_FALSE(beyond);
    CHECK(beyond.error().code == Errc::invalid_argument);
    CHECK(beyond.error().message == "the G-buffer has 4 targets; number 4 was asked for");
    settings.keep_gbuffer = false;
    auto lost = test::must(Renderer<Null>::create(device, full_scene(), settings));
    REQUIRE_FALSE(lost->read_gbuffer(0));
    CHECK(lost->read_gbuffer(0).error().code == Errc::invalid_argument);
}
