// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The G-buffer pass: opaque and alpha-masked surfaces, one draw an instance, no bind between draws.
#include <pellucid/gpu/gbuffer.h>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/shaders/gbuffer.hpp>

namespace pellucid::inline v0_1 {

/// How surfaces are stored (gpu/gbuffer.h).
enum class GBufferLayout : std::uint8_t {
    compact,  ///< 16 bytes a pixel: position comes from depth, normals are octahedral (largest error 0.0025°)
    classic   ///< 36 bytes a pixel: stored world position, half-float normals; kept to be measured
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(GBufferLayout l) noexcept {
    return l == GBufferLayout::compact ? "compact" : "classic";
}

/// The colour formats of a layout, in attachment order; the last is emitted radiance where it is asked for.
[[nodiscard]] constexpr SmallVector<rhi::Format, 5> gbuffer_formats(GBufferLayout layout, bool emissive) {
    using enum rhi::Format;
    SmallVector<rhi::Format, 5> formats;
    if (layout == GBufferLayout::compact)
        formats = {r32_uint, rgba8_srgb, r32_uint};
    else
        formats = {rgba32_float, rgba16_float, rgba8_srgb, rgba8_unorm};
    if (emissive) formats.push_back(rgba16_float);
    return formats;
}

/// Which layout, and what of the scene its shaders must handle.
struct GBufferDesc {
    GBufferLayout layout = GBufferLayout::compact;
    bool emissive = false;                    ///< add the target for emitted radiance
    bool emitted_only = false;                ///< that target alone, which is the picture: no light falls on anything
    std::uint32_t needs = PELLUCID_NEED_ALL;  ///< PELLUCID_NEED_* of the scene
    std::uint32_t culls = 7;                  ///< bit (1 << Cull) for each way of culling in use
};

/// `[h, w]` textures of gbuffer_formats(), or the rgba16_float picture where there is emitted radiance only, and
/// d32_float depth (reversed, cleared to 0).
struct GBufferTargets {
    SmallVector<rhi::Texture, 5> colors = {};
    rhi::Texture depth = {};
    Extent2D size = {};
    float background[3] = {0, 0, 0};  ///< linear radiance that the picture is cleared to; emitted_only
};

/// Rasterises surfaces into a G-buffer, the same bits on every API; depth test greater-or-equal, so that of two equal
/// depths the later draw wins. Shaders: shaders/gbuffer.  Reference: reference/gbuffer.hpp.
template <rhi::Backend B>
class GBufferPass {
public:
    /// Errors: those of pipeline creation.
    [[nodiscard]] static Result<GBufferPass> create(typename B::Device& device, const GBufferDesc& desc);

    /// Records one render pass that clears and fills `targets`.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, const GBufferTargets& targets, const SceneBinding& scene,
                std::span<const DrawItem> items) const;

private:
    CullVariants<B> pipelines_;
    bool emitted_only_ = false;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<GBufferPass<B>> GBufferPass<B>::create(typename B::Device& device, const GBufferDesc& desc) {
    GBufferPass pass;
    pass.emitted_only_ = desc.emitted_only;
    const bool compact = desc.layout == GBufferLayout::compact;
    const rhi::SpecConstant constants[] = {{0, desc.needs}};
    rhi::GraphicsPipelineDesc pipeline{.vertex = &shaders::scene_vert,
                                       .fragment = desc.emitted_only ? &shaders::gbuffer_emitted_frag
                                                   : compact         ? &shaders::gbuffer_frag
                                                                     : &shaders::gbuffer_classic_frag,
                                       .constants = constants,
                                       .scene_group = scene_group_layout(),
                                       .depth = {.format = rhi::Format::d32_float,
                                                 .test = true,
                                                 .write = true,
                                                 .compare = rhi::Compare::greater_equal},
                                       .debug_name = "gbuffer"};
    if (desc.emitted_only)
        pipeline.colors.push_back({.format = rhi::Format::rgba16_float});
    else
        for (const rhi::Format format : gbuffer_formats(desc.layout, desc.emissive))
            pipeline.colors.push_back({.format = format});
    PELLUCID_CHECK(pass.pipelines_.create(device, pipeline, desc.culls));
    return pass;
}

template <rhi::Backend B>
void GBufferPass<B>::record(typename B::Commands& cmd, const GBufferTargets& targets, const SceneBinding& scene,
                            std::span<const DrawItem> items) const {
    rhi::RenderPassDesc pass{
        .depth = {.texture = targets.depth}, .uses = scene.uses, .size = targets.size, .name = "gbuffer"};
    pass.uses.push_back(rhi::use(scene.indices, rhi::Access::index_read));
    // What depth says is not covered is never read, so colours need no clear; a picture does.
    const auto& b = targets.background;
    for (const rhi::Texture texture : targets.colors)
        pass.colors.push_back({.texture = texture,
                               .load = emitted_only_ ? rhi::Load::clear : rhi::Load::discard,
                               .clear = {b[0], b[1], b[2], 1}});
    cmd.begin_render(pass);
    draw_items<B>(cmd, pipelines_, scene, items);
    cmd.end_render();
}

}  // namespace pellucid::inline v0_1
