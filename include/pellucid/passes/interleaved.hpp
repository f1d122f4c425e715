// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Deferred translucency: coverage, order, alpha and transmittance exact in every pixel, light on one translucent
/// surface a pixel, in the lighting pass of what is opaque.
#include <pellucid/gpu/interleaved.h>
#include <pellucid/passes/list_compositor.hpp>
#include <pellucid/shaders/interleaved.hpp>

namespace pellucid::inline v0_1 {

/// Deferred translucency's memory, its end of a pixel, its audit.
struct InterleavedDesc {
    FragmentDesc fragments = {};
    std::uint64_t memory_budget = 0;  ///< [byte] for stored fragments; 0: what the device can bind
    float min_transmittance = 0;      ///< a pixel is done where no more gets through; 0: only what nothing can change
    bool audit = false;               ///< keep how many surfaces were lit for each pixel, and composite them all
};

/// `[h, w]` each; `hdr` is the frame's.
struct InterleavedTargets {
    rhi::Texture hdr = {};    ///< rgba16_float, storage
    rhi::Texture nodes = {};  ///< rgba32_uint, storage, sampled and attachment: the surface that each pixel lights
    rhi::Texture looks = {};  ///< the same
    rhi::Texture light = {};  ///< rgba16_float, sampled: what the lighting pass makes of them
};

/// After Inferred Lighting (Kircher and Lawrance 2009), but nothing is stolen from what is opaque and nothing but light
/// is interpolated: each pixel's fragments are listed (FragmentLists); one of them is lit per pixel, chosen so that of
/// n layers every 2×2 quad lights each of the nearest four; compositing takes the light on the other layers from the
/// neighbours that lit the same surface (same instance, in its plane, like normal and material). Where no neighbour
/// fits, or they differ from each other by more than 6 %, the layer is lit on the spot: edges and highlights are exact,
/// smooth surfaces cost one evaluation a pixel whatever their number.  Linear HDR throughout.
/// What it loses: light that changes within a pixel of a surface whose neighbours agree.  Shaders: shaders/interleaved.
template <rhi::Backend B>
class InterleavedPass {
public:
    /// `counts`: LayerCountPass::counts().  Errors: those of creation.
    [[nodiscard]] static Result<InterleavedPass> create(typename B::Device& device, const InterleavedDesc& desc,
                                                        const InterleavedTargets& targets, rhi::Texture counts);
    /// Once the counts are on the CPU: decides the bands and makes room.  Errors: those of `split_strips`, of memory.
    [[nodiscard]] Result<void> prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips);
    /// Before the lighting pass: lists the fragments and chooses what each pixel lights.  `depth` is tested and not
    /// written.  Precondition of both: no pass is open.
    void record_select(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                       std::span<const DrawItem> items) const;
    /// After it: composites the layers over `hdr`.
    void record_merge(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                      std::span<const DrawItem> items) const;

    /// Its audit: surfaces lit for each pixel.
    [[nodiscard]] const ListCompositor<B>& compositor() const { return compositor_; }

private:
    [[nodiscard]] rhi::GroupDesc select_group() const {
        return compositor_.lists().walker_group(
            {{PELLUCID_INTERLEAVED_NODE, targets_.nodes}, {PELLUCID_INTERLEAVED_LOOK, targets_.looks}}, {}, {},
            "interleaved.select");
    }
    [[nodiscard]] rhi::GroupDesc merge_group() const {
        return compositor_.group({{PELLUCID_INTERLEAVED_NODES, targets_.nodes},
                                  {PELLUCID_INTERLEAVED_LOOKS, targets_.looks},
                                  {PELLUCID_INTERLEAVED_LIGHT, targets_.light}},
                                 sampler_, "interleaved.merge");
    }
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device);

    InterleavedDesc desc_;
    InterleavedTargets targets_;
    ListCompositor<B> compositor_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> select_group_, merge_group_;
    typename ListCompositor<B>::Pipelines select_, merge_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<InterleavedPass<B>> InterleavedPass<B>::create(typename B::Device& device, const InterleavedDesc& desc,
                                                      const InterleavedTargets& targets, rhi::Texture counts) {
    InterleavedPass pass;
    pass.desc_ = desc;
    pass.targets_ = targets;
    PELLUCID_TRY(pass.compositor_, ListCompositor<B>::create(device,
                                                             {.lists = {.fragments = desc.fragments,
                                                                        .content = FragmentContent::surfaces,
                                                                        .memory_budget = desc.memory_budget,
                                                                        .visit_turns = 1 + 9 + desc.fragments.lights},
                                                              .min_transmittance = desc.min_transmittance,
                                                              .audit = desc.audit},
                                                             targets.hdr, counts));
    PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("interleaved")));
    PELLUCID_CHECK(pass.make_pipelines(device));
    return pass;
}

template <rhi::Backend B>
Result<void> InterleavedPass<B>::make_pipelines(typename B::Device& device) {
    using namespace shaders;
    const rhi::Shader* const selects[] = {&interleaved_select_8_comp, &interleaved_select_deep_comp};
    const rhi::Shader* const merges[2][2] = {{&interleaved_merge_8_comp, &interleaved_merge_deep_comp},
                                             {&interleaved_merge_8_comp_exact, &interleaved_merge_deep_comp_exact}};
    const rhi::GroupLayout select_layout = select_group().layout, merge_layout = merge_group().layout;
    const auto constants = compositor_.constants(device.info());
    for (std::uint32_t c = 0; c < PELLUCID_LISTS_CLASS_COUNT; c += 2) {
        rhi::ComputePipelineDesc pipeline{.compute = selects[c / 2],
                                          .constants = constants,
                                          .pass_group = select_layout,
                                          .scene_group = scene_group_layout(),
                                          .push_bytes = sizeof(gpu::ListBand),
                                          .debug_name = "interleaved.select"};
        PELLUCID_OWN(select_[c], device, device.make_pipeline(pipeline));
        pipeline.compute = merges[desc_.fragments.exact ? 1 : 0][c / 2];
        pipeline.pass_group = merge_layout;
        pipeline.debug_name = "interleaved.merge";
        PELLUCID_OWN(merge_[c], device, device.make_pipeline(pipeline));
    }
    return {};
}

template <rhi::Backend B>
Result<void> InterleavedPass<B>::prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips) {
    PELLUCID_TRY(const bool made, compositor_.lists().prepare(device, strips));
    if (!made) return {};
    PELLUCID_OWN(select_group_, device, device.make_group(select_group()));
    PELLUCID_OWN(merge_group_, device, device.make_group(merge_group()));
    return {};
}

template <rhi::Backend B>
void InterleavedPass<B>::record_select(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                                       std::span<const DrawItem> items) const {
    using enum rhi::Access;
    cmd.begin_render({.colors = {{.texture = targets_.nodes}, {.texture = targets_.looks}},
                      .size = desc_.fragments.size,
                      .name = "interleaved.clear"});
    cmd.end_render();
    const rhi::Pipeline pipelines[] = {select_[0], select_[1], select_[2], select_[3]};
    const FragmentLists<B>& lists = compositor_.lists();
    for (const StripBand& band : lists.bands()) {
        lists.record(cmd, band, depth, scene, items);
        lists.walk(cmd, band, scene, {rhi::use(targets_.nodes, storage_write), rhi::use(targets_.looks, storage_write)},
                   pipelines, select_group_, 0, "interleaved.select");
    }
}

template <rhi::Backend B>
void InterleavedPass<B>::record_merge(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                                      std::span<const DrawItem> items) const {
    compositor_.begin(cmd, "interleaved.audit");
    const rhi::Texture textures[] = {targets_.nodes, targets_.looks, targets_.light};
    const FragmentLists<B>& lists = compositor_.lists();
    for (const StripBand& band : lists.bands()) {
        // Only one band at a time is in memory.
        if (lists.bands().size() > 1) lists.record(cmd, band, depth, scene, items);
        compositor_.record(cmd, band, scene, textures, merge_, merge_group_, "interleaved.merge");
    }
}

}  // namespace pellucid::inline v0_1
