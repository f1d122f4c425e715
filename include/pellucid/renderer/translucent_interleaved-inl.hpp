// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Translucent<B>: methods whose surfaces the lighting pass lights.
#include <pellucid/renderer/translucent.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_skyx_layers(std::span<const GraphTexture> colors,
                                                     const GBufferTargets& gbuffer) {
    using enum rhi::TextureUsage;
    const GraphTexture marks = target(rhi::Format::d32_float_s8_uint, attachment, "interleaved_skyx.marks");
    lighting_.depth = target(rhi::Format::r32_float, attachment | sampled, "interleaved_skyx.depth");
    lighting_.output = lit_target("interleaved_skyx.light");
    skyx_info_ = target(rhi::Format::r32_uint, attachment | sampled, "interleaved_skyx.info");
    GraphPassDesc layers{
        .name = "interleaved_skyx.layers", .reads = {targets_.depth}, .writes = {marks, lighting_.depth, skyx_info_}};
    for (const GraphTexture color : colors) {
        layers.reads.push_back(color);
        layers.writes.push_back(color);
    }
    graph_->add(
        layers,
        [this, marks, &gbuffer](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(interleaved_skyx_,
                         InterleavedSkyxPass<B>::create(device,
                                                        {.gbuffer = {.layout = settings_->gbuffer,
                                                                     .emissive = needs_.emissive_target,
                                                                     .needs = needs_.mask,
                                                                     .culls = scene_->translucent_culls()},
                                                         .alpha_gain = settings_->skyx_alpha_gain},
                                                        {.hdr = (*this)[targets_.hdr],
                                                         .gbuffer = gbuffer,
                                                         .marks = (*this)[marks],
                                                         .depth = (*this)[lighting_.depth],
                                                         .info = (*this)[skyx_info_],
                                                         .light = (*this)[lighting_.output]}));
            pipelines_ += culls() + 2;
            return {};
        },
        [this](typename B::Commands& cmd) {
            interleaved_skyx_->record_layers(cmd, scene_->binding(), scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_skyx_merge() {
    graph_->add(
        {.name = "interleaved_skyx",
         .reads = {lighting_.output, lighting_.depth, skyx_info_},
         .writes = {targets_.hdr}},
        [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) { interleaved_skyx_->record_merge(cmd); });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_select() {
    using enum rhi::TextureUsage;
    declare_layer_count();
    lighting_.nodes = target(rhi::Format::rgba32_uint, storage | sampled | attachment, "interleaved.nodes");
    lighting_.looks = target(rhi::Format::rgba32_uint, storage | sampled | attachment, "interleaved.looks");
    lighting_.layer_light = lit_target("interleaved.light");
    graph_->add(
        {.name = "interleaved.select",
         .reads = {targets_.depth},
         .writes = {lighting_.nodes, lighting_.looks},
         .live = true},
        [this](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(interleaved_, InterleavedPass<B>::create(device,
                                                                  {.fragments = fragments(),
                                                                   .memory_budget = settings_->memory_budget,
                                                                   .min_transmittance = settings_->min_transmittance,
                                                                   .audit = settings_->audit},
                                                                  {.hdr = (*this)[targets_.hdr],
                                                                   .nodes = (*this)[lighting_.nodes],
                                                                   .looks = (*this)[lighting_.looks],
                                                                   .light = (*this)[lighting_.layer_light]},
                                                                  count_->counts()));
            pipelines_ += culls() + 1 + 2 * 2;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            PELLUCID_CHECK(interleaved_->prepare(*device_, count_->strips()));
            interleaved_->record_select(frame.commands(), (*this)[targets_.depth], scene_->binding(),
                                        scene_->translucent());
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_interleaved_merge() {
    graph_->add(
        {.name = "interleaved",
         .reads = {targets_.hdr, targets_.depth, lighting_.nodes, lighting_.looks, lighting_.layer_light},
         .writes = {targets_.hdr}},
        [](typename B::Device&) -> Result<void> { return {}; },
        [this](typename B::Commands& cmd) {
            interleaved_->record_merge(cmd, (*this)[targets_.depth], scene_->binding(), scene_->translucent());
        });
}

}  // namespace pellucid::inline v0_1
