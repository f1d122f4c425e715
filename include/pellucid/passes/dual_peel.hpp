// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Dual depth peeling (Bavoil and Myers 2008), the well-known way to peel from both ends.
#include <pellucid/gpu/dual_peel.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/dual_peel.hpp>
#include <algorithm>
#include <array>

namespace pellucid {

struct DualPeelDesc {
    FragmentDesc fragments = {};
    std::uint32_t max_passes = 0;  ///< each peels two layers; 0: as many as there are
};

/// `[h, w]` each; `hdr` and `opaque` are the frame's, the rest belongs to the pass.
struct DualPeelTargets {
    rhi::Texture hdr = {};       ///< rgba16_float, attachment
    rhi::Texture opaque = {};    ///< d32_float, attachment: tested, never written
    rhi::Texture range[2] = {};  ///< rg32_float, attachment and sampled
    rhi::Texture front[2] = {};  ///< rgba32_float, attachment and sampled
    rhi::Texture layer = {};     ///< rgba32_float, attachment and sampled
    rhi::Texture back = {};      ///< rgba32_float, attachment and sampled
};

/// Each pass composites the nearest fragment left of a pixel under the front layers and the farthest one over the back
/// layers, in single precision; it goes on until nothing is left.  Exact but for fragments of equal depth: of those of
/// one pixel a single one, of the largest colour by channel, remains, and a test with a tolerance would double or lose
/// others instead.  Shaders: shaders/dual_peel.
template <rhi::Backend B>
class DualPeelPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<DualPeelPass> create(typename B::Device& device, const DualPeelDesc& desc,
                                                     const DualPeelTargets& targets);
    /// Starts a frame.  Precondition of this and of all that record: no pass is open.
    void begin(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items);
    /// Records some passes more.
    void record_passes(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items);
    /// Once what was recorded is done: whether there is anything left to peel.  Errors: those of the queries.
    [[nodiscard]] Result<bool> more(typename B::Device& device);
    /// Records the layers over `hdr`.
    void composite(typename B::Commands& cmd) const { composite_[recorded_ % 2].record(cmd, over_hdr_); }

    [[nodiscard]] std::uint32_t passes() const { return found_; }  ///< of the last frame that peeled anything

private:
    static constexpr std::uint32_t batch_limit = 64;
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device);

    DualPeelDesc desc_;
    DualPeelTargets targets_;
    rhi::RenderPassDesc over_hdr_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> peel_groups_[2];
    rhi::Unique<typename B::Device, rhi::Queries> queries_;
    FullScreenPass<B> back_[2], composite_[2];
    CullVariants<B> range_, peel_;
    std::uint32_t recorded_ = 0, in_batch_ = 0, batch_ = 2, found_ = 0;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<DualPeelPass<B>> DualPeelPass<B>::create(typename B::Device& device, const DualPeelDesc& desc,
                                                const DualPeelTargets& targets) {
    DualPeelPass pass;
    pass.desc_ = desc;
    pass.targets_ = targets;
    pass.over_hdr_ = {.colors = {{.texture = targets.hdr, .load = rhi::Load::load}}, .size = desc.fragments.size};
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("dual_peel")));
    PELLUCID_OWN(
        pass.queries_, device,
        device.make_queries({.kind = rhi::QueryKind::occlusion, .count = batch_limit, .debug_name = "dual_peel.left"}));
    PELLUCID_CHECK(pass.make_pipelines(device));
    return pass;
}

template <rhi::Backend B>
Result<void> DualPeelPass<B>::make_pipelines(typename B::Device& device) {
    using enum rhi::BlendFactor;
    using enum rhi::Format;
    constexpr rhi::Blend most{true, one, one, rhi::BlendOp::max, one, one, rhi::BlendOp::max};
    PELLUCID_CHECK(range_.create(device,
                                 {.vertex = &shaders::scene_position_vert,
                                  .fragment = &shaders::dual_peel_range_frag,
                                  .scene_group = scene_group_layout(),
                                  .colors = {{.format = rg32_float, .blend = most}},
                                  .depth = FragmentDesc::depth_test(),
                                  .debug_name = "dual_peel.range"},
                                 desc_.fragments.culls));
    const auto constants = desc_.fragments.constants();
    PELLUCID_CHECK(
        peel_.create(device,
                     {.vertex = &shaders::scene_vert,
                      .fragment = desc_.fragments.exact ? &shaders::dual_peel_frag_exact : &shaders::dual_peel_frag,
                      .constants = constants,
                      .pass_group = sampled_layout({PELLUCID_DUAL_PEEL_RANGE, PELLUCID_DUAL_PEEL_FRONT}),
                      .scene_group = scene_group_layout(),
                      .colors = {{.format = rg32_float, .blend = most},
                                 {.format = rgba32_float, .blend = most},
                                 {.format = rgba32_float, .blend = most}},
                      .depth = FragmentDesc::depth_test(),
                      .debug_name = "dual_peel"},
                     desc_.fragments.culls));
    constexpr rhi::Blend over{
        true, one, one_minus_src_alpha, rhi::BlendOp::add, zero, one_minus_src_alpha, rhi::BlendOp::add};
    constexpr rhi::Blend behind{true, one, src_alpha, rhi::BlendOp::add, zero, one, rhi::BlendOp::add};
    for (std::size_t i = 0; i < 2; ++i) {  // i: the textures that are read
        PELLUCID_OWN(peel_groups_[i], device,
                     device.make_group(sampled_group(
                         sampler_,
                         {{PELLUCID_DUAL_PEEL_RANGE, targets_.range[i]}, {PELLUCID_DUAL_PEEL_FRONT, targets_.front[i]}},
                         "dual_peel")));
        PELLUCID_TRY(back_[i],
                     FullScreenPass<B>::create(device, {.fragment = &shaders::dual_peel_back_frag,
                                                        .textures = {{PELLUCID_DUAL_PEEL_RANGE, targets_.range[i]},
                                                                     {PELLUCID_DUAL_PEEL_BACK, targets_.layer}},
                                                        .colors = {{.format = rgba32_float, .blend = over}},
                                                        .debug_name = "dual_peel.back"}));
        PELLUCID_TRY(composite_[i],
                     FullScreenPass<B>::create(device, {.fragment = &shaders::dual_peel_composite_frag,
                                                        .textures = {{PELLUCID_DUAL_PEEL_FRONT, targets_.front[i]},
                                                                     {PELLUCID_DUAL_PEEL_BACK, targets_.back}},
                                                        .colors = {{.format = rgba16_float, .blend = behind}},
                                                        .debug_name = "dual_peel.composite"}));
    }
    return {};
}

template <rhi::Backend B>
void DualPeelPass<B>::begin(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) {
    recorded_ = in_batch_ = 0;
    cmd.begin_render({.colors = {{.texture = targets_.front[0]}, {.texture = targets_.back, .clear = {0, 0, 0, 1}}},
                      .size = desc_.fragments.size,
                      .name = "dual_peel.clear"});
    cmd.end_render();
    constexpr float none = PELLUCID_DUAL_PEEL_NONE;
    rhi::RenderPassDesc pass = desc_.fragments.render_pass(targets_.opaque, scene, "dual_peel.range");
    pass.colors.push_back({.texture = targets_.range[0], .clear = {none, none, 0, 0}});
    cmd.begin_render(pass);
    draw_items<B>(cmd, range_, scene, items);
    cmd.end_render();
}

template <rhi::Backend B>
void DualPeelPass<B>::record_passes(typename B::Commands& cmd, const SceneBinding& scene,
                                    std::span<const DrawItem> items) {
    using enum rhi::Access;
    constexpr float none = PELLUCID_DUAL_PEEL_NONE;
    cmd.reset(queries_);
    for (in_batch_ = 0; in_batch_ < batch_; ++in_batch_, ++recorded_) {
        if (desc_.max_passes != 0 && recorded_ == desc_.max_passes) return;
        const std::size_t from = recorded_ % 2, to = 1 - from;
        rhi::RenderPassDesc pass = desc_.fragments.render_pass(targets_.opaque, scene, "dual_peel");
        pass.colors.push_back({.texture = targets_.range[to], .clear = {none, none, 0, 0}});
        pass.colors.push_back({.texture = targets_.front[to]});
        pass.colors.push_back({.texture = targets_.layer});
        pass.uses.push_back(rhi::use(targets_.range[from], sampled));
        pass.uses.push_back(rhi::use(targets_.front[from], sampled));
        cmd.begin_render(pass);
        draw_items<B>(cmd, peel_, scene, items, peel_groups_[from]);
        cmd.end_render();
        back_[from].record(
            cmd, {.colors = {{.texture = targets_.back, .load = rhi::Load::load}}, .size = desc_.fragments.size},
            [&](typename B::Commands& c, auto&& draw) {
                c.begin_query(queries_, in_batch_);
                draw();
                c.end_query(queries_, in_batch_);
            });
    }
}

template <rhi::Backend B>
Result<bool> DualPeelPass<B>::more(typename B::Device& device) {
    std::array<std::uint64_t, batch_limit> left{};
    PELLUCID_CHECK(device.results(queries_, 0, std::span(left).first(in_batch_)));
    const auto end = left.begin() + in_batch_;
    const auto empty = std::find(left.begin(), end, std::uint64_t{0});
    found_ = recorded_ - static_cast<std::uint32_t>(end - empty);
    const bool capped = desc_.max_passes != 0 && recorded_ == desc_.max_passes;
    const bool more = empty == end && !capped;
    batch_ = std::min(more ? 2 * batch_ : found_ + 1, batch_limit);
    return more;
}

}  // namespace pellucid
