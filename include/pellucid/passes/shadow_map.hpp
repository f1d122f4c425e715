// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Draws what a light sees into one layer of an array of depth, as any other view of the scene is drawn: by a
/// FrameParams and DrawRecords of its own.  Opaque instances need no fragment stage, masked ones one that knows their
/// holes; each is culled as in the picture, so a single-sided surface casts only from its front.
///
/// What is made of the maps is in shaders/common/shadow.glsl; which maps there are, in renderer/shadow_fit.hpp.
#include <pellucid/gpu/shadow_map.h>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/shaders/shadow_map.hpp>

namespace pellucid::inline v0_1 {

/// What of the scene casts shadows.
struct ShadowMapDesc {
    std::uint32_t needs = PELLUCID_NEED_ALL;  ///< PELLUCID_NEED_* of the scene
    std::uint32_t opaque_culls = 7;           ///< bit (1 << Cull) for each way of culling of opaque casters
    std::uint32_t masked_culls = 7;           ///< the same of masked ones
};

/// A layer of an array, d32_float, `[size, size]`.
struct ShadowMapTarget {
    rhi::Texture maps = {};
    std::uint32_t layer = 0;
    std::uint32_t size = 0;
};

/// Draws the depth that a light sees.
template <rhi::Backend B>
class ShadowMapPass {
public:
    /// Errors: those of pipeline creation.
    [[nodiscard]] static Result<ShadowMapPass> create(typename B::Device& device, const ShadowMapDesc& desc);
    /// Records one render pass that clears and fills the layer.  `scene` is the map's view, and its group does not hold
    /// the array.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const ShadowMapTarget& target, const SceneBinding& scene,
                std::span<const DrawItem> opaque, std::span<const DrawItem> masked) const;
    [[nodiscard]] std::uint32_t pipelines() const noexcept { return count_; }

private:
    CullVariants<B> opaque_, masked_;
    std::uint32_t count_ = 0;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<ShadowMapPass<B>> ShadowMapPass<B>::create(typename B::Device& device, const ShadowMapDesc& desc) {
    ShadowMapPass pass;
    // Nothing but alpha is looked up.
    constexpr std::uint32_t of_alpha =
        PELLUCID_NEED_TEXTURES | PELLUCID_NEED_SECOND_UV | PELLUCID_NEED_VERTEX_COLORS | PELLUCID_NEED_ALPHA_MASK;
    const rhi::SpecConstant constants[] = {{0, desc.needs & of_alpha}};
    rhi::GraphicsPipelineDesc pipeline{.vertex = &shaders::scene_position_vert,
                                       .constants = constants,
                                       .scene_group = scene_group_layout(),
                                       .depth = {.format = rhi::Format::d32_float,
                                                 .test = true,
                                                 .write = true,
                                                 .compare = rhi::Compare::greater_equal},
                                       .debug_name = "shadow_map"};
    PELLUCID_CHECK(pass.opaque_.create(device, pipeline, desc.opaque_culls));
    pipeline.vertex = &shaders::scene_vert;
    pipeline.fragment = &shaders::shadow_map_masked_frag;
    PELLUCID_CHECK(pass.masked_.create(device, pipeline, desc.masked_culls));
    for (const CullVariants<B>* variants : {&pass.opaque_, &pass.masked_})
        for (const auto& made : variants->pipelines) pass.count_ += made ? 1 : 0;
    return pass;
}

template <rhi::Backend B>
void ShadowMapPass<B>::record(typename B::Commands& cmd, const ShadowMapTarget& target, const SceneBinding& scene,
                              std::span<const DrawItem> opaque, std::span<const DrawItem> masked) const {
    rhi::RenderPassDesc pass{.depth = {.texture = target.maps, .layer = target.layer},
                             .uses = scene.uses,
                             .size = {target.size, target.size},
                             .name = "shadow_map"};
    pass.uses.push_back(rhi::use(scene.indices, rhi::Access::index_read));
    cmd.begin_render(pass);
    draw_items<B>(cmd, opaque_, scene, opaque);
    draw_items<B>(cmd, masked_, scene, masked);
    cmd.end_render();
}

}  // namespace pellucid::inline v0_1
