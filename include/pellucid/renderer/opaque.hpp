// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the frame's opaque surfaces take: shadow maps, the G-buffer, light lists, lighting, light volumes; or one pass
/// in their place where no light falls on any.
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/passes/light_volumes.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/passes/shadow_map.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <optional>

namespace pellucid::inline v0_1 {

/// What surfaces of all kinds are drawn into and tested against.
struct FrameTargets {
    GraphTexture hdr, depth;  ///< rgba16_float; d32_float, null in a scene without surfaces
};

/// What a method of transparency asks of the lighting pass: textures of the graph, null where it asks for nothing.
struct LightingChanges {
    GraphTexture nodes, looks, layer_light;  ///< one translucent surface a pixel, and the light on it
    GraphTexture depth, output;              ///< what it reads instead of the frame's depth, and writes instead of hdr
};

/// Declares these passes in a graph, and owns them.  Must not move once `start` was called.
template <rhi::Backend B>
class Opaque {
public:
    /// All but `targets` must outlive the graph's use.  \param camera whose shadow maps a frame draws
    void start(Graph<B>& graph, GpuScene<B>& scene, const SceneNeeds& needs, const RenderSettings& settings,
               const Camera& camera, const FrameTargets& targets);
    void declare_shadows();
    /// Either this, then declare_lighting, where needs.lighting ...
    void declare_gbuffer();
    void declare_lighting(const LightingChanges& changes);
    /// ... or this: what is emitted, or the background alone.
    void declare_unlit();
    /// After the lights changed, which passes that exist read.
    void update_lights();

    /// The G-buffer's colours in the graph; none before declare_gbuffer.
    [[nodiscard]] std::span<const GraphTexture> colors() const noexcept { return colors_; }
    /// What was drawn into; null handles until passes are created, and where nothing is opaque.
    [[nodiscard]] const GBufferTargets& gbuffer() const noexcept { return gbuffer_; }
    [[nodiscard]] std::uint32_t pipelines() const noexcept { return pipelines_; }  ///< built so far
    /// Appends the buffers and textures that the passes own; the graph reports its own.
    void add_resources(std::vector<TextureReport>& out) const;

private:
    void declare_light_lists(GraphTexture depth);
    void declare_light_volumes(GraphTexture depth, GraphTexture output);
    void declare_emitted();
    void declare_background();
    /// Creates the pass that draws the surfaces into `gbuffer_`.
    [[nodiscard]] Result<void> create_fill(typename B::Device& device, const GBufferDesc& desc);
    void record_fill(typename B::Commands& cmd) {
        gbuffer_pass_->record(cmd, gbuffer_, scene_->binding(), scene_->opaque());
    }
    /// What lighting reads: the G-buffer with a depth that may be another's.
    [[nodiscard]] GBufferTargets surfaces(GraphTexture depth) const {
        GBufferTargets out = gbuffer_;
        out.depth = (*graph_)[depth];
        return out;
    }
    [[nodiscard]] LightingDesc lighting_desc() const {
        return {.layout = settings_->gbuffer,
                .emissive = needs_->emissive_target,
                .stage = settings_->shading,
                .brdf = settings_->brdf,
                .needs = needs_->mask,
                .exact = settings_->exact};
    }

    Graph<B>* graph_ = nullptr;
    GpuScene<B>* scene_ = nullptr;
    const SceneNeeds* needs_ = nullptr;
    const RenderSettings* settings_ = nullptr;
    const Camera* camera_ = nullptr;
    FrameTargets targets_;
    SmallVector<GraphTexture, 5> colors_;
    GBufferTargets gbuffer_;
    std::uint32_t pipelines_ = 0;
    std::optional<ShadowMapPass<B>> shadow_map_pass_;
    std::optional<GBufferPass<B>> gbuffer_pass_;
    std::optional<LightListsPass<B>> light_lists_pass_;
    std::optional<LightingPass<B>> lighting_pass_;
    std::optional<LightVolumesPass<B>> light_volumes_pass_;
};

}  // namespace pellucid::inline v0_1

#include <pellucid/renderer/opaque-inl.hpp>
