// SPDX-License-Identifier: MIT
// Every pass and the renderer, instantiated whole for the null backend: what compiles here uses the concepts and
// nothing else.  Then they run on it, inside Validated, and fail at each creation in turn.
#include <pellucid/renderer/instances.hpp>
#include <pellucid/rhi/null.hpp>
#include <pellucid/rhi/validated.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/framing.hpp>
#include <string>
#include <string_view>
#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/methods.hpp"
#include "support/pass_stage.hpp"

namespace pellucid::inline v0_1 {
PELLUCID_RENDERER_INSTANCES(, Null)
}  // namespace pellucid::inline v0_1

using namespace pellucid;

namespace {

/// The demo scene, with settings of one method.
RenderSettings small(Transparency method, bool audit = false) {
    return {.size = {64, 36}, .transparency = method, .audit = audit};
}
using test::none_and_all_methods;

/// Whether frames were begun and submitted in turn, the last one too.
bool in_turn(const null::Device& device) {
    bool open = false;
    for (const null::Call& call : device.calls()) {
        const std::string_view name = call.name;
        if (name == "begin_frame" || name == "submit") {
            if (open != (name == "submit")) return false;
            open = !open;
        }
    }
    return !open;
}

}  // namespace

TEST_CASE("frames of the demo scene keep every rule of the RHI", "[cpu]") {
    test::Log log;  // a violation fails the test
    const Scene scene = make_demo_scene();
    for (const Transparency transparency : none_and_all_methods())
        for (const bool audit : {false, true}) {
            INFO(name(transparency) << (audit ? ", audited" : ""));
            auto device = test::must(Validated<Null>::create(log.desc()));
            {
                auto renderer =
                    test::must(Renderer<Validated<Null>>::create(*device, scene, small(transparency, audit)));
                for (int frame = 0; frame < 3; ++frame) {
                    test::must(renderer->render(scene.cameras.front()));
                    (void)test::must(renderer->count_layers());
                }
                (void)test::must(renderer->read_display());
                if (const auto composited = renderer->read_composited(); !composited)
                    CHECK(composited.error().code == Errc::invalid_argument);
            }
            CHECK(device->violations() == 0);
            CHECK(device->live_objects() == 0);
        }
}

TEST_CASE("methods that list fragments keep every rule in one band, in several and in none", "[cpu]") {
    // The null device counts no fragment, so the strips are made up.
    using B = Validated<Null>;
    test::Log log;
    const Scene scene = make_demo_scene();
    auto device = test::must(B::create(log.desc()));
    const auto walk = [&](test::PassStage<B>& stage, LayerCountPass<B>& count, auto& pass, auto&& record) {
        for (const std::uint32_t slots : {0u, 100u, 400u, 1000u, 0u, 400u}) {
            const std::vector<gpu::LayerStrip> strips(5, {.slots = slots});
            stage.frame(scene.cameras.front(), [&](Frame<B>& f) -> Result<void> {
                count.record(f.commands(), stage.depth(), stage.scene().binding(), stage.scene().translucent());
                PELLUCID_CHECK(f.flush());
                PELLUCID_CHECK(pass.prepare(*device, strips));
                record(f.commands());
                return {};
            });
            CHECK(pass.compositor().lists().bands().size() == (slots == 0     ? 0
                                                               : slots == 100 ? 1
                                                               : slots == 400 ? 3
                                                                              : 5));
        }
        CHECK_FALSE(pass.prepare(*device, std::vector<gpu::LayerStrip>(5, {.slots = 1001})));
    };
    {
        test::PassStage<B> stage(*device, scene, {.size = {64, 36}});
        auto count = test::must(LayerCountPass<B>::create(*device, stage.fragments()));
        using enum rhi::TextureUsage;
        const auto image = [&](rhi::Format format) {
            return stage.target(format, storage | sampled | attachment, "surfaces");
        };
        const auto nodes = image(rhi::Format::rgba32_uint), looks = image(rhi::Format::rgba32_uint),
                   light = image(rhi::Format::rgba16_float);
        for (const bool audit : {false, true}) {
            for (const FragmentContent content : {FragmentContent::colors, FragmentContent::surfaces}) {
                const std::uint64_t place_bytes = content == FragmentContent::colors ? 16 : 32;
                auto pass = test::must(AbufferPass<B>::create(*device,
                                                              {.fragments = stage.fragments(),
                                                               .content = content,
                                                               .memory_budget = 1000 * place_bytes,
                                                               .audit = audit},
                                                              stage.hdr_target(), count.counts()));
                walk(stage, count, pass, [&](B::Commands& cmd) {
                    pass.record(cmd, stage.depth(), stage.scene().binding(), stage.scene().translucent());
                });
            }
            auto pass = test::must(InterleavedPass<B>::create(
                *device, {.fragments = stage.fragments(), .memory_budget = 32000, .audit = audit},
                {.hdr = stage.hdr_target(), .nodes = nodes, .looks = looks, .light = light}, count.counts()));
            walk(stage, count, pass, [&](B::Commands& cmd) {
                pass.record_select(cmd, stage.depth(), stage.scene().binding(), stage.scene().translucent());
                pass.record_merge(cmd, stage.depth(), stage.scene().binding(), stage.scene().translucent());
            });
        }
    }
    CHECK(device->violations() == 0);
    CHECK(device->live_objects() == 0);
}

TEST_CASE("wherever memory runs out, the renderer says so and leaves nothing behind", "[cpu]") {
    const Scene scene = make_demo_scene();
    for (const Transparency transparency : none_and_all_methods()) {
        int failures = 0;
        for (std::uint64_t n = 1; n < 1000; ++n) {
            auto device = test::must(Null::create({}));
            device->fail_after(n);
            bool failed = false;
            {
                auto renderer = Renderer<Null>::create(*device, scene, small(transparency));
                if (!renderer) {
                    CHECK(renderer.error().code == Errc::out_of_memory);
                    CHECK_FALSE(renderer.error().message.empty());
                    failed = true;
                } else if (const auto drawn = (*renderer)->render(scene.cameras.front()); !drawn) {
                    CHECK(drawn.error().code == Errc::out_of_memory);
                    failed = true;
                }
            }
            INFO(name(transparency) << ": creation " << n << " failed");
            REQUIRE(device->live_objects() == 0);
            if (!failed) break;
            ++failures;
        }
        CHECK(failures > 10);
        CHECK(failures < 900);
    }
}

TEST_CASE("after a frame that failed the device begins another one", "[cpu]") {
    const Scene scene = make_demo_scene();
    for (const Transparency transparency : none_and_all_methods()) {
        auto device = test::must(Null::create({}));
        auto renderer = test::must(Renderer<Null>::create(*device, scene, small(transparency)));
        std::uint64_t n = 1;
        for (; n < 100; ++n) {  // uniforms, records; both once more after each flush
            device->fail_after(n);
            const bool drawn = static_cast<bool>(renderer->render(scene.cameras.front()));
            device->fail_after(0);
            INFO(name(transparency) << ": upload " << n);
            CHECK(in_turn(*device));
            CHECK(renderer->render(scene.cameras.front()));
            CHECK(in_turn(*device));
            if (drawn) break;
        }
        CHECK(n > 2);
        CHECK(n < 100);
        device->fail_after(1);
        if (const auto counted = renderer->count_layers(); !counted) CHECK(counted.error().code == Errc::out_of_memory);
        device->fail_after(0);
        CHECK(in_turn(*device));
        CHECK(renderer->count_layers());
    }
}

TEST_CASE("a lost device is a result", "[cpu]") {
    const Scene scene = make_demo_scene();
    for (const Transparency transparency : none_and_all_methods()) {
        INFO(name(transparency));
        auto device = test::must(Null::create({}));
        {
            auto renderer = test::must(Renderer<Null>::create(*device, scene, small(transparency)));
            test::must(renderer->render(scene.cameras.front()));
            device->lose();
            const auto drawn = renderer->render(scene.cameras.front());
            REQUIRE_FALSE(drawn);
            CHECK(drawn.error().code == Errc::device_lost);
            if (transparency != Transparency::none) {
                const auto counted = renderer->count_layers();
                REQUIRE_FALSE(counted);
                CHECK(counted.error().code == Errc::device_lost);
            }
        }
        CHECK(device->live_objects() == 0);
    }
}
