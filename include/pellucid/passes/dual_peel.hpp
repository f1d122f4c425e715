// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Dual depth peeling (Bavoil and Myers 2008), the well-known way to peel from both ends.
#include <pellucid/gpu/dual_peel.h>
#include <pellucid/passes/fragment_desc.hpp>
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/shaders/dual_peel.hpp>
#include <algorithm>

namespace pellucid::inline v0_1 {

/// How far dual peeling goes.
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
/// layers, in single precision; there are as many as the deepest pixel takes.  Exact but for fragments of equal depth:
/// of those of one pixel a single one, of the largest colour by channel, remains, and a test with a tolerance would
/// double or lose others instead.  Shaders: shaders/dual_peel.
template <rhi::Backend B>
class DualPeelPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<DualPeelPass> create(typename B::Device& device, const DualPeelDesc& desc,
                                                     const DualPeelTargets& targets);
    /// Records everything.  `deepest`: fragments of the deepest pixel (LayerCountPass::totals()); each pass peels two.
    /// Precondition: no pass is open.
    void record(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
                std::uint32_t deepest);

    [[nodiscard]] std::uint32_t passes() const { return passes_; }  ///< of the last frame
    [[nodiscard]] bool truncated() const { return truncated_; }     ///< max_passes left layers out

private:
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device);
    void find_range(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items) const;
    /// One pass; `from`: the range and the front layers that it reads.
    void peel(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
              std::size_t from) const;

    DualPeelDesc desc_;
    DualPeelTargets targets_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> peel_groups_[2];
    FullScreenPass<B> back_, composite_[2];
    CullVariants<B> range_, peel_;
    std::uint32_t passes_ = 0;
    bool truncated_ = false;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<DualPeelPass<B>> DualPeelPass<B>::create(typename B::Device& device, const DualPeelDesc& desc,
                                                const DualPeelTargets& targets) {
    DualPeelPass pass;
    pass.desc_ = desc;
    pass.targets_ = targets;
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("dual_peel")));
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
    PELLUCID_TRY(back_, FullScreenPass<B>::create(device, {.fragment = &shaders::dual_peel_back_frag,
                                                           .textures = {{PELLUCID_DUAL_PEEL_BACK, targets_.layer}},
                                                           .colors = {{.format = rgba32_float, .blend = over}},
                                                           .debug_name = "dual_peel.back"}));
    constexpr rhi::Blend behind{true, one, src_alpha, rhi::BlendOp::add, zero, one, rhi::BlendOp::add};
    for (std::size_t i = 0; i < 2; ++i) {  // i: the textures that are read
        PELLUCID_OWN(peel_groups_[i], device,
                     device.make_group(sampled_group(
                         sampler_,
                         {{PELLUCID_DUAL_PEEL_RANGE, targets_.range[i]}, {PELLUCID_DUAL_PEEL_FRONT, targets_.front[i]}},
                         "dual_peel")));
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
void DualPeelPass<B>::find_range(typename B::Commands& cmd, const SceneBinding& scene,
                                 std::span<const DrawItem> items) const {
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
void DualPeelPass<B>::peel(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
                           std::size_t from) const {
    using enum rhi::Access;
    constexpr float none = PELLUCID_DUAL_PEEL_NONE;
    const std::size_t to = 1 - from;
    rhi::RenderPassDesc pass = desc_.fragments.render_pass(targets_.opaque, scene, "dual_peel");
    pass.colors.push_back({.texture = targets_.range[to], .clear = {none, none, 0, 0}});
    pass.colors.push_back({.texture = targets_.front[to]});
    pass.colors.push_back({.texture = targets_.layer});
    pass.uses.push_back(rhi::use(targets_.range[from], sampled));
    pass.uses.push_back(rhi::use(targets_.front[from], sampled));
    cmd.begin_render(pass);
    draw_items<B>(cmd, peel_, scene, items, peel_groups_[from]);
    cmd.end_render();
    back_.record(cmd, {.colors = {{.texture = targets_.back, .load = rhi::Load::load}}, .size = desc_.fragments.size});
}

template <rhi::Backend B>
void DualPeelPass<B>::record(typename B::Commands& cmd, const SceneBinding& scene, std::span<const DrawItem> items,
                             std::uint32_t deepest) {
    const std::uint32_t needed = (deepest + 1) / 2;
    passes_ = desc_.max_passes == 0 ? needed : std::min(needed, desc_.max_passes);
    truncated_ = passes_ < needed;
    if (passes_ == 0) return;
    find_range(cmd, scene, items);
    for (std::uint32_t i = 0; i < passes_; ++i) peel(cmd, scene, items, i % 2);
    composite_[passes_ % 2].record(
        cmd, {.colors = {{.texture = targets_.hdr, .load = rhi::Load::load}}, .size = desc_.fragments.size});
}

}  // namespace pellucid::inline v0_1
