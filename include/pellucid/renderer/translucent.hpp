// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the frame's translucent surfaces take, by the method that the settings ask for.
#include <pellucid/graph/graph.hpp>
#include <pellucid/passes/abuffer.hpp>
#include <pellucid/passes/layer_count.hpp>
#include <pellucid/passes/sorted_forward.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <bit>
#include <optional>

namespace pellucid {

/// Declares one method's passes in a graph, and owns them.  Must not move once `declare` was called.
template <rhi::Backend B>
class Translucent {
public:
    struct Targets {
        GraphTexture hdr, depth;  ///< rgba16_float, read and written; d32_float, read
    };
    /// `scene` and `settings` must outlive the graph's use.
    void declare(Graph<B>& graph, const GpuScene<B>& scene, const SceneNeeds& needs, const RenderSettings& settings,
                 const Targets& targets);

    [[nodiscard]] std::uint32_t pipelines() const noexcept { return pipelines_; }  ///< built so far

private:
    void declare_sorted();
    void declare_layer_count();
    void declare_abuffer();
    [[nodiscard]] std::uint32_t culls() const {
        return static_cast<std::uint32_t>(std::popcount(scene_->translucent_culls()));
    }

    Graph<B>* graph_ = nullptr;
    const GpuScene<B>* scene_ = nullptr;
    const RenderSettings* settings_ = nullptr;
    std::uint32_t needs_ = 0;
    Targets targets_;
    typename B::Device* device_ = nullptr;
    std::uint32_t pipelines_ = 0;
    std::optional<SortedForwardPass<B>> sorted_;
    std::optional<LayerCountPass<B>> count_;
    std::optional<AbufferPass<B>> abuffer_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
void Translucent<B>::declare(Graph<B>& graph, const GpuScene<B>& scene, const SceneNeeds& needs,
                             const RenderSettings& settings, const Targets& targets) {
    graph_ = &graph;
    scene_ = &scene;
    settings_ = &settings;
    needs_ = needs.mask;
    targets_ = targets;
    if (!needs.translucent) {
        const bool off = settings.transparency == Transparency::none;
        graph.leave_out("transparency", off ? "transparency is switched off" : "the scene has no translucent surface");
        return;
    }
    switch (settings.transparency) {
        case Transparency::none:
            break;
        case Transparency::sorted:
            return declare_sorted();
        case Transparency::abuffer:
            return declare_abuffer();
    }
}

template <rhi::Backend B>
void Translucent<B>::declare_sorted() {
    graph_->add(
        {.name = "sorted_forward", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr}},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(sorted_, SortedForwardPass<B>::create(device, {.brdf = settings_->brdf,
                                                                        .needs = needs_,
                                                                        .culls = scene_->translucent_culls(),
                                                                        .exact = settings_->exact}));
            pipelines_ += culls();
            return {};
        },
        [this](typename B::Commands& cmd) {
            sorted_->record(cmd, (*graph_)[targets_.hdr], (*graph_)[targets_.depth], settings_->size, scene_->binding(),
                            scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_layer_count() {
    graph_->add(
        {.name = "layer_count", .reads = {targets_.depth}, .live = true},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(count_, LayerCountPass<B>::create(device, settings_->size, scene_->translucent_culls()));
            pipelines_ += culls() + 1;
            return {};
        },
        [this](typename B::Commands& cmd) {
            count_->record(cmd, (*graph_)[targets_.depth], scene_->binding(), scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_abuffer() {
    declare_layer_count();
    graph_->add(
        {.name = "abuffer", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr}},
        [this](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(abuffer_, AbufferPass<B>::create(device,
                                                          {.size = settings_->size,
                                                           .brdf = settings_->brdf,
                                                           .needs = needs_,
                                                           .culls = scene_->translucent_culls(),
                                                           .exact = settings_->exact,
                                                           .memory_budget = settings_->memory_budget,
                                                           .min_transmittance = settings_->min_transmittance,
                                                           .audit = settings_->audit},
                                                          (*graph_)[targets_.hdr], count_->counts()));
            pipelines_ += culls() + 2;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            PELLUCID_CHECK(abuffer_->prepare(*device_, count_->strips()));
            abuffer_->record(frame.commands(), (*graph_)[targets_.depth], scene_->binding(), scene_->translucent());
            return {};
        });
}

}  // namespace pellucid
