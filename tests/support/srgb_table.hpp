// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a driver makes of the 256 sRGB codes when it reads them: software drivers use a polynomial that is up to 1 %
/// off in the dark, so a test of what comes after must start from the driver's own values.
#include <array>
#include "support/gpu.hpp"

namespace pellucid::test {

/// Linear value of every 8-bit sRGB code, as texelFetch gives it.
template <class D>
[[nodiscard]] std::array<float, 256> srgb_table(D& device) {
    constexpr Extent2D size{256, 1};
    std::array<std::uint32_t, 256> texels;
    for (std::uint32_t i = 0; i < 256; ++i) texels[i] = i * 0x010101u | 0xFF000000u;
    const auto source = own(device, device.make_texture({.size = size,
                                                         .format = rhi::Format::rgba8_srgb,
                                                         .initial = std::as_bytes(std::span(texels)),
                                                         .debug_name = "srgb codes"}));
    const auto target = make_target(device, size, rhi::Format::rgba32_float);
    const auto sampler = own(device, device.make_sampler({.min = rhi::Filter::nearest, .mag = rhi::Filter::nearest}));
    auto desc = quad_desc(rhi::Format::rgba32_float);
    desc.vertex = &shaders::test_fullscreen_vert;
    desc.fragment = &shaders::test_fetch_frag;
    desc.pass_group = {{{12, rhi::BindingKind::sampled_texture}}};
    const auto pipeline = own(device, device.make_pipeline(desc));
    const auto group =
        own(device, device.make_group({.layout = desc.pass_group,
                                       .bindings = {{.binding = 12, .texture = source, .sampler = sampler}}}));
    run(device, [&](auto& commands) {
        commands.begin_render(
            {.colors = {{.texture = target}}, .uses = {rhi::use(source.get(), rhi::Access::sampled)}, .size = size});
        commands.bind_pipeline(pipeline);
        commands.bind_group(group);
        commands.draw({.vertex_count = 3});
        commands.end_render();
    });
    const ImageF values = read<float>(device, target, size, 4);
    std::array<float, 256> out;
    for (std::uint32_t i = 0; i < 256; ++i) out[i] = values.texel(i, 0)[0];
    return out;
}

}  // namespace pellucid::test
