// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Depth peeling as the document the project grew from has it, kept to be measured.
#include <pellucid/gpu/peel.h>
#include <pellucid/gpu/peel_seed.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/peel.hpp>
#include <pellucid/shaders/peel_seed.hpp>

namespace pellucid::inline v0_1 {

/// How many layers, and which of two composites.
struct PeelSeedDesc {
    FragmentDesc fragments = {};
    std::uint32_t layers = PELLUCID_PEEL_SEED_LAYERS;  ///< > 0
    bool composite_as_written = false;                 ///< see PeelSeedPass
};

/// `[h, w]` each; `hdr` and `opaque` are the frame's, the rest belongs to the pass.
struct PeelSeedTargets {
    rhi::Texture hdr = {};       ///< rgba16_float, attachment
    rhi::Texture opaque = {};    ///< d32_float, sampled: never written
    rhi::Texture depth[2] = {};  ///< d32_float, attachment and sampled
    rhi::Texture layer = {};     ///< rgba8_unorm, attachment and sampled
    rhi::Texture sum = {};       ///< rgba8_unorm, attachment and sampled
};

/// A fixed number of layers, each the nearest fragments whose depth is more than 1e-4 behind the last layer's, found by
/// two depth buffers in turn; composited front to back into 8 bits that are cleared to (0, 0, 0, 1), with the factors
/// DST_ALPHA, ONE for colour and ZERO, ONE_MINUS_SRC_ALPHA for alpha; then over the picture with ONE, SRC_ALPHA.
/// What it loses: layers beyond the number, layers closer than the epsilon (10 cm at 10 m with the near plane at
/// 0.1 m), all but one of several fragments of equal depth, radiance above 1, and what 8 bits cannot hold.
/// The document itself composites with ONE, ONE_MINUS_SRC_ALPHA although alpha holds what gets *through*: what is
/// behind shows by 1 - T instead of T, and where nothing is it vanishes (`composite_as_written`).
/// Shaders: shaders/peel_seed.
template <rhi::Backend B>
class PeelSeedPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<PeelSeedPass> create(typename B::Device& device, const PeelSeedDesc& desc,
                                                     const PeelSeedTargets& targets);
    /// Records all layers and the composite.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) const;

private:
    PeelSeedDesc desc_;
    PeelSeedTargets targets_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> layer_groups_[2];
    FullScreenPass<B> blend_, composite_;
    CullVariants<B> layer_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<PeelSeedPass<B>> PeelSeedPass<B>::create(typename B::Device& device, const PeelSeedDesc& desc,
                                                const PeelSeedTargets& targets) {
    using enum rhi::BlendFactor;
    PeelSeedPass pass;
    pass.desc_ = desc;
    pass.targets_ = targets;
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("peel_seed")));
    for (std::size_t i = 0; i < 2; ++i) {
        PELLUCID_OWN(pass.layer_groups_[i], device,
                     device.make_group(sampled_group(pass.sampler_,
                                                     {{PELLUCID_PEEL_SEED_PREVIOUS, targets.depth[1 - i]},
                                                      {PELLUCID_PEEL_SEED_OPAQUE, targets.opaque}},
                                                     "peel_seed.layer")));
    }
    const auto constants = desc.fragments.constants();
    PELLUCID_CHECK(pass.layer_.create(
        device,
        {.vertex = &shaders::scene_vert,
         .fragment = desc.fragments.exact ? &shaders::peel_seed_layer_frag_exact : &shaders::peel_seed_layer_frag,
         .constants = constants,
         .pass_group = sampled_layout({PELLUCID_PEEL_SEED_PREVIOUS, PELLUCID_PEEL_SEED_OPAQUE}),
         .scene_group = scene_group_layout(),
         .colors = {{.format = rhi::Format::rgba8_unorm}},
         .depth = {.format = rhi::Format::d32_float, .test = true, .write = true},
         .debug_name = "peel_seed.layer"},
        desc.fragments.culls));
    PELLUCID_TRY(pass.blend_,
                 FullScreenPass<B>::create(device, {.fragment = &shaders::peel_composite_frag,
                                                    .textures = {{PELLUCID_PEEL_SUM, targets.layer}},
                                                    .colors = {{.format = rhi::Format::rgba8_unorm,
                                                                .blend = {true, dst_alpha, one, rhi::BlendOp::add, zero,
                                                                          one_minus_src_alpha, rhi::BlendOp::add}}},
                                                    .debug_name = "peel_seed.blend"}));
    const rhi::BlendFactor behind = desc.composite_as_written ? one_minus_src_alpha : src_alpha;
    PELLUCID_TRY(
        pass.composite_,
        FullScreenPass<B>::create(
            device, {.fragment = &shaders::peel_composite_frag,
                     .textures = {{PELLUCID_PEEL_SUM, targets.sum}},
                     .colors = {{.format = rhi::Format::rgba16_float,
                                 .blend = {true, one, behind, rhi::BlendOp::add, zero, one, rhi::BlendOp::add}}},
                     .debug_name = "peel_seed.composite"}));
    return pass;
}

template <rhi::Backend B>
void PeelSeedPass<B>::record(typename B::Commands& cmd, const SceneBinding& scene,
                             std::span<const DrawItem> items) const {
    using enum rhi::Access;
    // Nothing is in front of depth 1: the first layer is all there is.
    cmd.begin_render({.colors = {{.texture = targets_.sum, .clear = {0, 0, 0, 1}}},
                      .depth = {.texture = targets_.depth[1], .clear = 1},
                      .size = desc_.fragments.size,
                      .name = "peel_seed.clear"});
    cmd.end_render();
    for (std::uint32_t i = 0; i < desc_.layers; ++i) {
        rhi::RenderPassDesc pass{.colors = {{.texture = targets_.layer}},
                                 .depth = {.texture = targets_.depth[i % 2]},
                                 .uses = scene.uses,
                                 .size = desc_.fragments.size,
                                 .name = "peel_seed.layer"};
        pass.uses.push_back(rhi::use(targets_.depth[1 - i % 2], sampled));
        pass.uses.push_back(rhi::use(targets_.opaque, sampled));
        pass.uses.push_back(rhi::use(scene.indices, index_read));
        cmd.begin_render(pass);
        draw_items<B>(cmd, layer_, scene, items, layer_groups_[i % 2]);
        cmd.end_render();
        blend_.record(cmd,
                      {.colors = {{.texture = targets_.sum, .load = rhi::Load::load}}, .size = desc_.fragments.size});
    }
    composite_.record(cmd,
                      {.colors = {{.texture = targets_.hdr, .load = rhi::Load::load}}, .size = desc_.fragments.size});
}

}  // namespace pellucid::inline v0_1
