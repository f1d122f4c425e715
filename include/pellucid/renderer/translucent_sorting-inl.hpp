// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of Translucent<B>: methods that put fragments in order after the lighting pass.
#include <pellucid/renderer/translucent.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
void Translucent<B>::declare_sorted() {
    graph_->add(
        {.name = "sorted_forward", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr}},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(sorted_, SortedForwardPass<B>::create(device, {.brdf = settings_->brdf,
                                                                        .needs = needs_.mask,
                                                                        .culls = scene_->translucent_culls(),
                                                                        .exact = settings_->exact}));
            pipelines_ += culls();
            return {};
        },
        [this](typename B::Commands& cmd) {
            sorted_->record(cmd, (*this)[targets_.hdr], (*this)[targets_.depth], settings_->size, scene_->binding(),
                            scene_->translucent());
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_peel() {
    using enum rhi::TextureUsage;
    declare_layer_count();
    const GraphTexture next = target(rhi::Format::r32_float, attachment | sampled | copy_source, "peel.next");
    const GraphTexture layer = target(rhi::Format::d32_float, attachment, "peel.layer");
    const GraphTexture sum = target(rhi::Format::rgba32_float, attachment | sampled | copy_source, "peel.sum");
    graph_->keep(peel_next_ = next);
    graph_->keep(peel_sum_ = sum);
    GraphPassDesc pass{
        .name = "peel", .reads = {targets_.hdr, targets_.depth}, .writes = {targets_.hdr, next, layer, sum}};
    GraphTexture count;
    if (settings_->audit) {
        count = target(rhi::Format::r32_float, attachment | copy_source, "peel.count");
        pass.writes.push_back(count);
    }
    graph_->add(
        pass,
        [this, next, layer, sum, count](typename B::Device& device) -> Result<void> {
            device_ = &device;
            PELLUCID_TRY(peel_, PeelPass<B>::create(device,
                                                    {.fragments = fragments(),
                                                     .max_layers = settings_->max_layers,
                                                     .min_transmittance = settings_->min_transmittance,
                                                     .audit = settings_->audit},
                                                    {.hdr = (*this)[targets_.hdr],
                                                     .opaque = (*this)[targets_.depth],
                                                     .next = (*this)[next],
                                                     .layer = (*this)[layer],
                                                     .sum = (*this)[sum],
                                                     .count = count ? (*this)[count] : rhi::Texture{}}));
            pipelines_ += 3 * culls() + 3;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            std::vector<rhi::Rect> areas = layer_areas(count_->tile_depths(), settings_->size);
            bool more = !areas.empty();
            peel_->begin(std::move(areas));
            while (more) {
                peel_->record_layers(frame.commands(), scene_->binding(), scene_->translucent(),
                                     scene_->translucent_reversed());
                PELLUCID_CHECK(frame.flush());
                PELLUCID_TRY(more, peel_->more(*device_));
            }
            peel_->composite(frame.commands());
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_peel_seed() {
    using enum rhi::TextureUsage;
    const GraphTexture layer = target(rhi::Format::rgba8_unorm, attachment | sampled, "peel_seed.layer");
    const GraphTexture sum = target(rhi::Format::rgba8_unorm, attachment | sampled, "peel_seed.sum");
    const GraphTexture depths[] = {target(rhi::Format::d32_float, attachment | sampled, "peel_seed.depth"),
                                   target(rhi::Format::d32_float, attachment | sampled, "peel_seed.depth")};
    graph_->add(
        {.name = "peel_seed",
         .reads = {targets_.hdr, targets_.depth},
         .writes = {targets_.hdr, layer, sum, depths[0], depths[1]}},
        [this, layer, sum, depth0 = depths[0], depth1 = depths[1]](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(peel_seed_,
                         PeelSeedPass<B>::create(
                             device,
                             {.fragments = fragments(),
                              .layers = settings_->max_layers ? settings_->max_layers : PELLUCID_PEEL_SEED_LAYERS,
                              .composite_as_written = settings_->seed_composite},
                             {.hdr = (*this)[targets_.hdr],
                              .opaque = (*this)[targets_.depth],
                              .depth = {(*this)[depth0], (*this)[depth1]},
                              .layer = (*this)[layer],
                              .sum = (*this)[sum]}));
            pipelines_ += culls() + 2;
            return {};
        },
        [this](typename B::Commands& cmd) { peel_seed_->record(cmd, scene_->binding(), scene_->translucent()); });
}

template <rhi::Backend B>
void Translucent<B>::declare_dual_peel() {
    using enum rhi::TextureUsage;
    using enum rhi::Format;
    declare_layer_count();
    struct Own {
        GraphTexture range[2], front[2], layer, back;
    } own;
    for (GraphTexture& t : own.range) t = target(rg32_float, attachment | sampled, "dual_peel.range");
    for (GraphTexture& t : own.front) t = target(rgba32_float, attachment | sampled, "dual_peel.front");
    own.layer = target(rgba32_float, attachment | sampled, "dual_peel.layer");
    own.back = target(rgba32_float, attachment | sampled, "dual_peel.back");
    graph_->add(
        {.name = "dual_peel",
         .reads = {targets_.hdr, targets_.depth},
         .writes = {targets_.hdr, own.range[0], own.range[1], own.front[0], own.front[1], own.layer, own.back}},
        [this, own](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(dual_peel_, DualPeelPass<B>::create(
                                         device, {.fragments = fragments(), .max_passes = settings_->max_layers},
                                         {.hdr = (*this)[targets_.hdr],
                                          .opaque = (*this)[targets_.depth],
                                          .range = {(*this)[own.range[0]], (*this)[own.range[1]]},
                                          .front = {(*this)[own.front[0]], (*this)[own.front[1]]},
                                          .layer = (*this)[own.layer],
                                          .back = (*this)[own.back]}));
            pipelines_ += 2 * culls() + 3;
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            dual_peel_->record(frame.commands(), scene_->binding(), scene_->translucent(), count_->totals().deepest);
            return {};
        });
}

template <rhi::Backend B>
void Translucent<B>::declare_layer_count() {
    graph_->add(
        {.name = "layer_count", .reads = {targets_.depth}, .live = true},
        [this](typename B::Device& device) -> Result<void> {
            PELLUCID_TRY(count_, LayerCountPass<B>::create(device, fragments()));
            pipelines_ += culls() + 1;
            return {};
        },
        [this](typename B::Commands& cmd) {
            count_->record(cmd, (*this)[targets_.depth], scene_->binding(), scene_->translucent());
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
                                                          {.fragments = fragments(),
                                                           .content = fragment_content(),
                                                           .memory_budget = settings_->memory_budget,
                                                           .min_transmittance = settings_->min_transmittance,
                                                           .audit = settings_->audit},
                                                          (*this)[targets_.hdr], count_->counts()));
            pipelines_ += culls() + 1 + (fragment_content() == FragmentContent::surfaces ? 2 : 4);
            return {};
        },
        [this](Frame<B>& frame) -> Result<void> {
            PELLUCID_CHECK(frame.flush());  // the counts
            PELLUCID_CHECK(abuffer_->prepare(*device_, count_->strips()));
            abuffer_->record(frame.commands(), (*this)[targets_.depth], scene_->binding(), scene_->translucent());
            return {};
        });
}

}  // namespace pellucid::inline v0_1
