// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Bodies of PeelPass<B>.
#include <pellucid/passes/peel.hpp>

namespace pellucid::inline v0_1 {

template <rhi::Backend B>
Result<PeelPass<B>> PeelPass<B>::create(typename B::Device& device, const PeelDesc& desc, const PeelTargets& targets) {
    PeelPass pass;
    pass.desc_ = desc;
    pass.targets_ = targets;
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("peel")));
    PELLUCID_OWN(pass.layer_group_, device,
                 device.make_group(sampled_group(
                     pass.sampler_, {{PELLUCID_PEEL_NEXT, targets.next}, {PELLUCID_PEEL_OPAQUE, targets.opaque}},
                     "peel.layer")));
    PELLUCID_OWN(
        pass.queries_, device,
        device.make_queries({.kind = rhi::QueryKind::occlusion, .count = batch_limit, .debug_name = "peel.samples"}));
    PELLUCID_CHECK(pass.make_pipelines(device));
    return pass;
}

template <rhi::Backend B>
Result<void> PeelPass<B>::make_pipelines(typename B::Device& device) {
    using enum rhi::BlendFactor;
    constexpr rhi::Blend nearest{true, one, one, rhi::BlendOp::max, one, one, rhi::BlendOp::max};
    rhi::GraphicsPipelineDesc find{.vertex = &shaders::scene_position_vert,
                                   .fragment = &shaders::peel_nearest_frag,
                                   .scene_group = scene_group_layout(),
                                   .colors = {{.format = rhi::Format::r32_float, .blend = nearest}},
                                   .depth = FragmentDesc::depth_test(),
                                   .debug_name = "peel.nearest"};
    PELLUCID_CHECK(first_.create(device, find, desc_.fragments.culls));
    find.depth.compare = rhi::Compare::less;
    PELLUCID_CHECK(nearest_.create(device, find, desc_.fragments.culls));

    constexpr rhi::Blend under{true, dst_alpha, one, rhi::BlendOp::add, zero, one_minus_src_alpha, rhi::BlendOp::add};
    constexpr rhi::Blend add{true, one, one, rhi::BlendOp::add, one, one, rhi::BlendOp::add};
    const auto constants = desc_.fragments.constants();
    rhi::GraphicsPipelineDesc shade{
        .vertex = &shaders::scene_vert,
        .fragment = desc_.fragments.exact ? &shaders::peel_layer_frag_exact : &shaders::peel_layer_frag,
        .constants = constants,
        .pass_group = sampled_layout({PELLUCID_PEEL_NEXT, PELLUCID_PEEL_OPAQUE}),
        .scene_group = scene_group_layout(),
        .colors = {{.format = rhi::Format::rgba32_float, .blend = under}},
        .depth = {.format = rhi::Format::d32_float, .test = true, .compare = rhi::Compare::equal},
        .debug_name = "peel.layer"};
    if (desc_.audit) shade.colors.push_back({.format = rhi::Format::r32_float, .blend = add});
    PELLUCID_CHECK(layer_.create(device, shade, desc_.fragments.culls));

    const auto make_advance = [&](std::uint32_t is_first) {
        const rhi::SpecConstant constant[] = {{2, is_first}};
        return FullScreenPass<B>::create(
            device,
            {.fragment = &shaders::peel_advance_frag,
             .constants = constant,
             .textures = {{PELLUCID_PEEL_NEXT, targets_.next},
                          {PELLUCID_PEEL_OPAQUE, targets_.opaque},
                          {PELLUCID_PEEL_SUM, targets_.sum}},
             .depth = {.format = rhi::Format::d32_float, .test = true, .write = true, .compare = rhi::Compare::always},
             .push_bytes = sizeof(gpu::PeelAdvance),
             .debug_name = "peel.advance"});
    };
    PELLUCID_TRY(advance_first_, make_advance(1));
    PELLUCID_TRY(advance_, make_advance(0));
    constexpr rhi::Blend over{true, one, src_alpha, rhi::BlendOp::add, zero, one, rhi::BlendOp::add};
    PELLUCID_TRY(composite_,
                 FullScreenPass<B>::create(device, {.fragment = &shaders::peel_composite_frag,
                                                    .textures = {{PELLUCID_PEEL_SUM, targets_.sum}},
                                                    .colors = {{.format = rhi::Format::rgba16_float, .blend = over}},
                                                    .debug_name = "peel.composite"}));
    return {};
}

template <rhi::Backend B>
void PeelPass<B>::begin(std::vector<rhi::Rect> areas) {
    areas_ = std::move(areas);
    recorded_ = in_batch_ = found_ = 0;
    probed_ = truncated_ = false;
}

template <rhi::Backend B>
void PeelPass<B>::nearest(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) const {
    const bool first = recorded_ == 0;
    rhi::RenderPassDesc pass =
        desc_.fragments.render_pass(first ? targets_.opaque : targets_.layer, scene, "peel.nearest");
    pass.colors.push_back({.texture = targets_.next, .clear = {-1, 0, 0, 0}});
    cmd.begin_render(pass);
    cmd.set_scissor(area(recorded_));
    draw_items<B>(cmd, first ? first_ : nearest_, scene, items);
    cmd.end_render();
}

template <rhi::Backend B>
void PeelPass<B>::advance(typename B::Commands& cmd) const {
    const gpu::PeelAdvance push{.min_transmittance = desc_.audit ? -1.0f : desc_.min_transmittance};
    const FullScreenPass<B>& pass = nothing_composited() ? advance_first_ : advance_;
    pass.record(cmd, {.depth = {.texture = targets_.layer, .clear = 0}, .size = desc_.fragments.size},
                [&](typename B::Commands& c, auto&& draw) {
                    c.push(rhi::bytes_of(push));
                    c.set_scissor(area(recorded_));
                    c.begin_query(queries_, in_batch_);
                    draw();
                    c.end_query(queries_, in_batch_);
                });
}

template <rhi::Backend B>
void PeelPass<B>::layer(typename B::Commands& cmd, const SceneBinding& scene,
                        std::span<const DrawItem> reversed) const {
    using enum rhi::Access;
    rhi::RenderPassDesc pass = desc_.fragments.render_pass(targets_.layer, scene, "peel.layer");
    add_sums(pass);
    pass.uses.push_back(rhi::use(targets_.next, sampled));
    pass.uses.push_back(rhi::use(targets_.opaque, sampled));
    cmd.begin_render(pass);
    cmd.set_scissor(area(recorded_));
    draw_items<B>(cmd, layer_, scene, reversed, layer_group_);
    cmd.end_render();
}

template <rhi::Backend B>
void PeelPass<B>::record_layers(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
                                std::span<const DrawItem> reversed) {
    cmd.reset(queries_);
    for (in_batch_ = 0; in_batch_ < batch_ && !recorded_all(); ++recorded_) {
        nearest(cmd, scene, items);
        advance(cmd);
        ++in_batch_;
        if (desc_.max_layers != 0 && recorded_ == desc_.max_layers) {
            probed_ = true;
            return;
        }
        if (recorded_ >= desc_.first_layer) layer(cmd, scene, reversed);
    }
}

template <rhi::Backend B>
Result<bool> PeelPass<B>::more(typename B::Device& device) {
    std::array<std::uint64_t, batch_limit> pixels{};
    PELLUCID_CHECK(device.results(queries_, 0, std::span(pixels).first(in_batch_)));
    const auto end = pixels.begin() + in_batch_;
    const auto empty = std::find(pixels.begin(), end, std::uint64_t{0});
    if (empty == end && !probed_ && !recorded_all()) {
        batch_ = std::min(2 * batch_, batch_limit);
        return true;
    }
    truncated_ = probed_ && empty == end;
    const std::uint32_t before = recorded_ + (probed_ ? 1 : 0) - in_batch_;
    found_ = truncated_ ? desc_.max_layers : before + static_cast<std::uint32_t>(empty - pixels.begin());
    batch_ = std::min(found_ + 1, batch_limit);  // the next frame is like this one
    return false;
}

template <rhi::Backend B>
void PeelPass<B>::composite(typename B::Commands& cmd) const {
    if (nothing_composited()) {  // only the sums are read
        rhi::RenderPassDesc clear{.size = desc_.fragments.size, .name = "peel.clear"};
        add_sums(clear);
        cmd.begin_render(clear);
        cmd.end_render();
        return;
    }
    composite_.record(cmd,
                      {.colors = {{.texture = targets_.hdr, .load = rhi::Load::load}}, .size = desc_.fragments.size},
                      [&](typename B::Commands& c, auto&& draw) {
                          c.set_scissor(area(0));
                          draw();
                      });
}

}  // namespace pellucid::inline v0_1
