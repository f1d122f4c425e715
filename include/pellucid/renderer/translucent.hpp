// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the frame's translucent surfaces take, by the method that the settings ask for.
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/abuffer.hpp>
#include <pellucid/passes/dual_peel.hpp>
#include <pellucid/passes/interleaved.hpp>
#include <pellucid/passes/interleaved_skyx.hpp>
#include <pellucid/passes/layer_areas.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/passes/peel.hpp>
#include <pellucid/passes/peel_seed.hpp>
#include <pellucid/passes/sorted_forward.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/renderer/opaque.hpp>
#include <pellucid/renderer/stats.hpp>
#include <pellucid/rhi/readback.hpp>
#include <array>
#include <bit>
#include <cstdio>
#include <optional>
#include <string>

namespace pellucid::inline v0_1 {

/// Declares one method's passes in a graph, and owns them.  Must not move once `start` was called.
template <rhi::Backend B>
class Translucent {
public:
    /// `scene` and `settings` must outlive the graph's use.
    void start(Graph<B>& graph, const GpuScene<B>& scene, const SceneNeeds& needs, const RenderSettings& settings,
               const FrameTargets& targets);
    /// Between the G-buffer, which `gbuffer` becomes when passes are created, and the lighting pass; not called where
    /// there is no lighting pass.
    LightingChanges declare_before_lighting(std::span<const GraphTexture> colors, const GBufferTargets& gbuffer);
    void declare_after_lighting();

    /// Counts the fragments of each pixel in a frame of its own, opened and closed here, and waits.  `[h, w, 1]`.
    /// `unsupported` on devices without float32_blending.
    [[nodiscard]] Result<Image<std::uint32_t>> count_layers(typename B::Device& device, Frame<B>& frame);
    /// What each pixel composited in the last frame; waits.  `invalid_argument` unless the method was audited.
    [[nodiscard]] Result<Image<std::uint32_t>> read_composited(typename B::Device& device) const;

    /// In [0,1]: the largest share of the light behind that gets through what the last frame composited, over the
    /// pixels where it may have left something out.  No pixel is off by more than this share of the largest radiance
    /// behind. Waits.  `invalid_argument` for methods that have no such bound: those that do not heed
    /// min_transmittance.
    [[nodiscard]] Result<double> read_transmittance_left(typename B::Device& device) const;

    [[nodiscard]] std::uint32_t pipelines() const noexcept { return pipelines_; }  ///< built so far
    /// Of the last frame.
    [[nodiscard]] TranslucencyStats stats() const;
    /// Appends the buffers and textures that the passes own; the graph reports its own.
    void add_resources(std::vector<TextureReport>& out) const;

private:
    void declare_sorted();
    void declare_peel();
    void declare_peel_seed();
    void declare_dual_peel();
    void declare_layer_count();
    void declare_abuffer();
    void declare_interleaved_skyx_layers(std::span<const GraphTexture> colors, const GBufferTargets& gbuffer);
    void declare_interleaved_skyx_merge();
    void declare_interleaved_select();
    void declare_interleaved_merge();

    [[nodiscard]] Result<Image<std::uint32_t>> read_numbers(typename B::Device& device, rhi::Texture texture,
                                                            rhi::Format format) const;
    [[nodiscard]] GraphTexture target(rhi::Format format, rhi::TextureUsage usage, const char* debug_name);
    /// What a lighting pass may write.
    [[nodiscard]] GraphTexture lit_target(const char* debug_name);
    [[nodiscard]] rhi::Texture operator[](GraphTexture t) const { return (*graph_)[t]; }
    [[nodiscard]] FragmentDesc fragments() const {
        return {.size = settings_->size,
                .brdf = settings_->brdf,
                .needs = needs_.mask,
                .lights = needs_.lights,
                .culls = scene_->translucent_culls(),
                .exact = settings_->exact};
    }
    /// Surfaces are lit where opaque ones are, but for scenes in which no light falls on any.
    [[nodiscard]] FragmentContent fragment_content() const {
        const bool lit = needs_.has(PELLUCID_NEED_NORMALS) && settings_->shading == ShadingStage::compute;
        return lit ? FragmentContent::surfaces : FragmentContent::colors;
    }
    /// Of the method that lists fragments, where one does.
    [[nodiscard]] const ListCompositor<B>* compositor() const {
        return abuffer_ ? &abuffer_->compositor() : interleaved_ ? &interleaved_->compositor() : nullptr;
    }
    [[nodiscard]] std::uint32_t culls() const {
        return static_cast<std::uint32_t>(std::popcount(scene_->translucent_culls()));
    }

    Graph<B>* graph_ = nullptr;
    const GpuScene<B>* scene_ = nullptr;
    const RenderSettings* settings_ = nullptr;
    SceneNeeds needs_;
    std::vector<const char*> own_targets_;  ///< names of the method's textures in the graph
    GraphTexture peel_next_, peel_sum_;
    FrameTargets targets_;
    LightingChanges lighting_;
    GraphTexture skyx_info_;
    typename B::Device* device_ = nullptr;  ///< once a pass was created
    std::uint32_t pipelines_ = 0;
    std::optional<SortedForwardPass<B>> sorted_;
    std::optional<LayerCountPass<B>> count_;
    std::optional<AbufferPass<B>> abuffer_;
    std::optional<PeelPass<B>> peel_;
    std::optional<PeelSeedPass<B>> peel_seed_;
    std::optional<DualPeelPass<B>> dual_peel_;
    std::optional<InterleavedSkyxPass<B>> interleaved_skyx_;
    std::optional<InterleavedPass<B>> interleaved_;
};

}  // namespace pellucid::inline v0_1

#include <pellucid/renderer/translucent-inl.hpp>
#include <pellucid/renderer/translucent_interleaved-inl.hpp>
#include <pellucid/renderer/translucent_sorting-inl.hpp>
