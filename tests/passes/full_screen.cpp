// SPDX-License-Identifier: MIT
// One triangle over the whole picture: every pixel once, each with its own texel.
#include <pellucid/passes/full_screen.hpp>
#include "support/gpu.hpp"

using namespace pellucid;
using namespace pellucid::test;

TEMPLATE_LIST_TEST_CASE("a full-screen pass draws every pixel once, from the texel at its place", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const Extent2D size : {Extent2D{1, 1}, Extent2D{7, 5}, Extent2D{64, 33}, Extent2D{1, 130}}) {
        std::vector<std::uint32_t> texels(std::size_t{size.width} * size.height);
        for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint32_t>(0x01020304u * i + i / 7);
        const auto source = own(
            *device,
            device->make_texture({.size = size, .initial = std::as_bytes(std::span(texels)), .debug_name = "source"}));
        const auto target = make_target(*device, size);
        // Twice what is there: a pixel that is drawn twice would be brighter, one that is missed black.
        const auto once = must(FullScreenPass<TestType>::create(
            *device, {.fragment = &shaders::test_fetch_frag,
                      .textures = {{12, source}},
                      .colors = {{.format = rhi::Format::rgba8_unorm,
                                  .blend = {true, rhi::BlendFactor::one, rhi::BlendFactor::one, rhi::BlendOp::add,
                                            rhi::BlendFactor::one, rhi::BlendFactor::one, rhi::BlendOp::add}}},
                      .debug_name = "copy"}));
        int calls = 0;
        run(*device, [&](auto& commands) {
            commands.begin_render({.colors = {{.texture = target}}, .size = size, .name = "clear"});
            commands.end_render();
            once.record(commands, {.colors = {{.texture = target, .load = rhi::Load::load}}, .size = size},
                        [&](auto&, auto&& draw) {
                            ++calls;
                            draw();
                        });
        });
        CHECK(calls == 1);
        const Image8 got = read<std::uint8_t>(*device, target, size, 4);
        INFO(size.width << "x" << size.height);
        CHECK(std::memcmp(got.data.data(), texels.data(), got.data.size()) == 0);
    }
}

TEST_CASE("the shape and the contents of a group of textures go together", "[cpu]") {
    const rhi::GroupDesc group = sampled_group({}, {{12, {}}, {14, {}}}, "two");
    CHECK(group.layout.bindings.size() == 2);
    CHECK(group.bindings.size() == 2);
    const rhi::GroupLayout layout = sampled_layout({12, 14});
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(group.layout.bindings[i] == layout.bindings[i]);
        CHECK(group.bindings[i].binding == layout.bindings[i].binding);
        CHECK(layout.bindings[i].kind == rhi::BindingKind::sampled_texture);
    }
}
