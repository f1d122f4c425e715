// SPDX-License-Identifier: MIT
// What settings choose: every method of transparency draws the same bits from run to run, with frames in flight, at
// another size, and says what it cannot tell.
#include <pellucid/renderer/settings.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include "support/methods.hpp"
#include "support/scene.hpp"
#include "support/transparency.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {
RenderSettings sized(Extent2D size, Transparency method) {
    RenderSettings settings = settings_for(1);
    settings.size = size;
    settings.transparency = method;
    return settings;
}
}  // namespace

TEST_CASE("every method has a name of its own, and the tests know it", "[cpu]") {
    std::vector<std::string> names;
    for (const Transparency t : none_and_all_methods()) {
        INFO(name(t));
        CHECK(find_facts(t).has_value());
        const std::string own = name(t);
        CHECK_FALSE(own.empty());
        CHECK(own.find('_') == std::string::npos);  // as the command line has it
        CHECK(std::count(names.begin(), names.end(), own) == 0);
        names.push_back(own);
    }
    CHECK_FALSE(any_order(Transparency::none));
    CHECK_FALSE(any_order(Transparency::sorted));
    CHECK(any_order(Transparency::peel));
    CHECK(any_order(Transparency::abuffer));
}

TEMPLATE_LIST_TEST_CASE("every method draws the same bits from run to run and with frames in flight", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_lit_glass();
    const Camera camera = scene.cameras.front();
    Camera other = camera;
    other.world_from_view = look_at({-4, 2.5, 3}, {0, 0.6, 0});
    for (const Transparency method : all_methods()) {
        INFO(name(method));
        const RenderSettings settings = sized({80, 60}, method);
        auto renderer = Renderer<TestType>::create(*device, scene, settings);
        if (!renderer && renderer.error().code == Errc::unsupported) {
            std::printf("%s on %s: %s\n", name(method), TestType::name, renderer.error().message.c_str());
            continue;
        }
        REQUIRE(renderer);
        (void)must((*renderer)->render(camera));
        const ImageF first = must((*renderer)->read_hdr());
        // Two frames of two renderers and two cameras in turn, none waited for.
        auto second = must(Renderer<TestType>::create(*device, scene, settings));
        for (int i = 0; i < 4; ++i) {
            (void)must((*renderer)->render(i % 2 ? camera : other));
            (void)must(second->render(i % 2 ? other : camera));
        }
        const ImageF again = must((*renderer)->read_hdr()), others = must(second->read_hdr());
        CHECK(different(again, first) == 0);
        CHECK(different(others, first) > 1000);
        (void)must(second->render(camera));
        CHECK(different(must(second->read_hdr()), first) == 0);
    }
}

TEMPLATE_LIST_TEST_CASE("every method draws at another size once the last renderer is gone", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_intersecting_planes();
    for (const Transparency method : all_methods()) {
        INFO(name(method));
        ImageF first;
        for (const Extent2D size : {Extent2D{64, 64}, {97, 33}, {64, 64}}) {
            const auto renderer = Renderer<TestType>::create(*device, scene, sized(size, method));
            if (!renderer && renderer.error().code == Errc::unsupported) break;
            REQUIRE(renderer);
            for (int frame = 0; frame < 2; ++frame) (void)must((*renderer)->render(scene.cameras.front()));
            const ImageF hdr = must((*renderer)->read_hdr());
            CHECK((hdr.width == size.width && hdr.height == size.height));
            if (size != Extent2D{64, 64}) continue;
            if (first.empty()) first = hdr;
            CHECK(different(hdr, first) == 0);
        }
    }
}

TEMPLATE_LIST_TEST_CASE("what was composited is told by audited methods that can tell, and by no other", "[gpu]",
                        Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const Scene scene = make_cyclic_triangles();
    for (const Transparency method : none_and_all_methods())
        for (const bool audit : {false, true}) {
            if (!audit && facts(method).audit == Audit::nothing) continue;  // not even when it is audited: below
            RenderSettings settings = sized({24, 24}, method);
            settings.audit = audit;
            const auto renderer = must(Renderer<TestType>::create(*device, scene, settings));
            (void)must(renderer->render(scene.cameras.front()));
            const auto composited = renderer->read_composited();
            INFO(name(method) << (audit ? ", audited" : ""));
            const bool told = audit && facts(method).audit != Audit::nothing;
            REQUIRE(static_cast<bool>(composited) == told);
            if (!told) {
                CHECK(composited.error().code == Errc::invalid_argument);
                CHECK(composited.error().message.find(name(method)) != std::string::npos);
            } else if (facts(method).audit == Audit::fragments) {
                CHECK(different(*composited, must(renderer->count_layers())) == 0);
            } else {
                // Unlit surfaces: the one that a pixel stands for, and no other.
                const auto counted = must(renderer->count_layers());
                CHECK(miscounted(*composited, [&](std::uint32_t x, std::uint32_t y) {
                          return std::min(*counted.texel(x, y), 1u);
                      }) == 0);
            }
        }
}
