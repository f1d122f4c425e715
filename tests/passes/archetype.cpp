// SPDX-License-Identifier: MIT
// Every pass and the renderer, instantiated whole for the null backend: what compiles here uses the concepts and
// nothing else.  Then they run on it, inside Validated, and fail at each creation in turn.
#include <pellucid/renderer/instances.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/framing.hpp>
#include <string>
#include "support/catch.hpp"
#include "support/devices.hpp"

namespace pellucid {
PELLUCID_RENDERER_INSTANCES(, Null)
}  // namespace pellucid

using namespace pellucid;

TEST_CASE("frames of the demo scene keep every rule of the RHI", "[cpu]") {
    test::Log log;  // a violation fails the test
    const Scene scene = make_demo_scene();
    for (const TransparencyTraits& method : all_transparencies) {
        INFO(method.name);
        auto device = test::must(Validated<Null>::create(log.desc()));
        {
            auto renderer = test::must(
                Renderer<Validated<Null>>::create(*device, scene, {.size = {64, 36}, .transparency = method.method}));
            for (int frame = 0; frame < 3; ++frame) test::must(renderer->render(scene.cameras.front()));
            (void)test::must(renderer->read_display());
        }
        CHECK(device->violations() == 0);
        CHECK(device->live_objects() == 0);
    }
}

TEST_CASE("wherever memory runs out, the renderer says so and leaves nothing behind", "[cpu]") {
    const Scene scene = make_demo_scene();
    int failures = 0;
    for (std::uint64_t n = 1; n < 1000; ++n) {
        auto device = test::must(Null::create({}));
        device->fail_after(n);
        bool failed = false;
        {
            auto renderer = Renderer<Null>::create(*device, scene, {.size = {64, 36}});
            if (!renderer) {
                CHECK(renderer.error().code == Errc::out_of_memory);
                CHECK_FALSE(renderer.error().message.empty());
                failed = true;
            } else if (const auto drawn = (*renderer)->render(scene.cameras.front()); !drawn) {
                CHECK(drawn.error().code == Errc::out_of_memory);
                failed = true;
            }
        }
        INFO("creation " << n << " failed");
        REQUIRE(device->live_objects() == 0);
        if (!failed) break;
        ++failures;
    }
    CHECK(failures > 10);
    CHECK(failures < 900);
}

TEST_CASE("a lost device is a result", "[cpu]") {
    const Scene scene = make_demo_scene();
    auto device = test::must(Null::create({}));
    {
        auto renderer = test::must(Renderer<Null>::create(*device, scene, {.size = {64, 36}}));
        test::must(renderer->render(scene.cameras.front()));
        device->lose();
        const auto drawn = renderer->render(scene.cameras.front());
        REQUIRE_FALSE(drawn);
        CHECK(drawn.error().code == Errc::device_lost);
    }
    CHECK(device->live_objects() == 0);
}
