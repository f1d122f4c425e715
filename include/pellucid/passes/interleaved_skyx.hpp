// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Interleaved translucency as SkyXEngine had it in 2018, kept to be measured.
#include <pellucid/gpu/interleaved_skyx.h>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/shaders/interleaved_skyx.hpp>

namespace pellucid::inline v0_1 {

/// The G-buffer that the layers share, and one of its peculiarities.
struct InterleavedSkyxDesc {
    GBufferDesc gbuffer = {};  ///< as that of the opaque pass; `culls` those of translucent instances
    bool alpha_gain = false;   ///< see InterleavedSkyxPass
};

/// `[h, w]` each; `hdr` and `gbuffer` are the frame's, the rest belongs to the pass.
struct InterleavedSkyxTargets {
    rhi::Texture hdr = {};        ///< rgba16_float, attachment
    GBufferTargets gbuffer = {};  ///< its depth is sampled and not written
    rhi::Texture marks = {};  ///< d32_float_s8_uint, attachment: depth of what is opaque, and what may be drawn where
    rhi::Texture depth = {};  ///< r32_float, attachment and sampled: of the surface that each pixel holds
    rhi::Texture info = {};   ///< r32_uint, attachment and sampled: gpu/interleaved_skyx.h
    rhi::Texture light = {};  ///< rgba16_float, sampled: what the lighting pass makes of `gbuffer` with `depth`
};

/// Of each 2×2 pixels one keeps what is opaque, and the stencil lets the others take 1, 2 and 3 translucent surfaces,
/// the last of which stays: three layers share the G-buffer with what is opaque, and one lighting pass lights all.  The
/// picture then unites at each pixel the surfaces of the window that starts there.
/// What it loses: opaque detail behind translucent surfaces (half the resolution, up to a pixel up and left),
/// silhouettes (a pixel wide), all but one surface of an instance, all but three layers (in the order in which they are
/// drawn: its sort never sorted, so the order is the scene's), alpha below 8/255, ids beyond 126.  Here light is united
/// in linear radiance; there it was in display-referred colour.  One of its versions also multiplied alpha by 1.1 at
/// each layer
/// (`alpha_gain`), which no colour depends on.  Sources: dogmanet/SkyXEngine, pp_union_alpha.ps and models.cpp of 2018.
/// Shaders: shaders/interleaved_skyx.
template <rhi::Backend B>
class InterleavedSkyxPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<InterleavedSkyxPass> create(typename B::Device& device, const InterleavedSkyxDesc& desc,
                                                            const InterleavedSkyxTargets& targets);
    /// Before the lighting pass: marks the pixels and draws `items` into the G-buffer.  Precondition of both: no pass
    /// is open.
    void record_layers(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) const;
    /// After it: writes every pixel of `hdr`.
    void record_merge(typename B::Commands& cmd) const;

private:
    [[nodiscard]] rhi::RenderPassDesc marked_pass(rhi::Load load) const;

    InterleavedSkyxTargets targets_;
    FullScreenPass<B> mark_, merge_;
    CullVariants<B> layer_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<InterleavedSkyxPass<B>> InterleavedSkyxPass<B>::create(typename B::Device& device,
                                                              const InterleavedSkyxDesc& desc,
                                                              const InterleavedSkyxTargets& targets) {
    using Op = rhi::StencilFace::Op;
    constexpr rhi::Format marks = rhi::Format::d32_float_s8_uint;
    const bool compact = desc.gbuffer.layout == GBufferLayout::compact;
    InterleavedSkyxPass pass;
    pass.targets_ = targets;
    const rhi::StencilFace replace{.pass = Op::replace};
    PELLUCID_TRY(pass.mark_,
                 FullScreenPass<B>::create(
                     device, {.fragment = &shaders::interleaved_skyx_mark_frag,
                              .textures = {{PELLUCID_SKYX_DEPTH, targets.gbuffer.depth}},
                              .colors = {{.format = rhi::Format::r32_float}, {.format = rhi::Format::r32_uint}},
                              .depth = {.format = marks,
                                        .test = true,
                                        .write = true,
                                        .compare = rhi::Compare::always,
                                        .stencil_test = true,
                                        .front = replace,
                                        .back = replace},
                              .push_bytes = sizeof(gpu::SkyxMark),
                              .debug_name = "interleaved_skyx.mark"}));
    const rhi::SpecConstant gain[] = {{2, desc.alpha_gain ? 1u : 0u}};
    PELLUCID_TRY(pass.merge_, FullScreenPass<B>::create(device, {.fragment = &shaders::interleaved_skyx_merge_frag,
                                                                 .constants = gain,
                                                                 .textures = {{PELLUCID_SKYX_LIGHT, targets.light},
                                                                              {PELLUCID_SKYX_DEPTH, targets.depth},
                                                                              {PELLUCID_SKYX_INFO, targets.info}},
                                                                 .colors = {{.format = rhi::Format::rgba16_float}},
                                                                 .debug_name = "interleaved_skyx.merge"}));
    const rhi::StencilFace count{.compare = rhi::Compare::not_equal, .pass = Op::decrement_clamp};
    const rhi::SpecConstant constants[] = {{0, desc.gbuffer.needs}};
    rhi::GraphicsPipelineDesc layer{
        .vertex = &shaders::scene_vert,
        .fragment = compact ? &shaders::interleaved_skyx_layer_frag : &shaders::interleaved_skyx_classic_layer_frag,
        .constants = constants,
        .scene_group = scene_group_layout(),
        .colors = {{.format = rhi::Format::r32_float}, {.format = rhi::Format::r32_uint}},
        .depth = {.format = marks,
                  .test = true,
                  .compare = rhi::Compare::greater_equal,
                  .stencil_test = true,
                  .front = count,
                  .back = count},
        .debug_name = "interleaved_skyx.layer"};
    for (const rhi::Format format : gbuffer_formats(desc.gbuffer.layout, desc.gbuffer.emissive))
        layer.colors.push_back({.format = format});
    PELLUCID_CHECK(pass.layer_.create(device, layer, desc.gbuffer.culls));
    return pass;
}

template <rhi::Backend B>
rhi::RenderPassDesc InterleavedSkyxPass<B>::marked_pass(rhi::Load load) const {
    return {.colors = {{.texture = targets_.depth, .load = load}, {.texture = targets_.info, .load = load}},
            .depth = {.texture = targets_.marks, .load = load},
            .size = targets_.gbuffer.size};
}

template <rhi::Backend B>
void InterleavedSkyxPass<B>::record_layers(typename B::Commands& cmd, const SceneBinding& scene,
                                           std::span<const DrawItem> items) const {
    mark_.record(cmd, marked_pass(rhi::Load::discard), [](typename B::Commands& inside, auto&& draw) {
        for (std::uint32_t surfaces = 0; surfaces < 4; ++surfaces) {
            inside.set_stencil_reference(static_cast<std::uint8_t>(surfaces));
            inside.push(rhi::bytes_of(gpu::SkyxMark{.parity = {surfaces >> 1, surfaces & 1, 0, 0}}));
            draw();
        }
    });
    rhi::RenderPassDesc pass = marked_pass(rhi::Load::load);
    for (const rhi::Texture color : targets_.gbuffer.colors)
        pass.colors.push_back({.texture = color, .load = rhi::Load::load});
    pass.uses = scene.uses;
    pass.uses.push_back(rhi::use(scene.indices, rhi::Access::index_read));
    pass.name = "interleaved_skyx.layers";
    cmd.begin_render(pass);
    draw_items<B>(cmd, layer_, scene, items);
    cmd.end_render();
}

template <rhi::Backend B>
void InterleavedSkyxPass<B>::record_merge(typename B::Commands& cmd) const {
    merge_.record(cmd,
                  {.colors = {{.texture = targets_.hdr, .load = rhi::Load::discard}}, .size = targets_.gbuffer.size});
}

}  // namespace pellucid::inline v0_1
