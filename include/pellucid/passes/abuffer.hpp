// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exact transparency of any order and depth: an A-buffer (Carpenter 1984) of exactly the size that the frame needs.
#include <pellucid/gpu/abuffer.h>
#include <pellucid/passes/fragment_lists.hpp>
#include <pellucid/shaders/abuffer.hpp>

namespace pellucid {

struct AbufferDesc {
    FragmentDesc fragments = {};
    FragmentContent content = FragmentContent::colors;  ///< surfaces: lit in compute, and only what is seen
    std::uint64_t memory_budget = 0;                    ///< [byte] for stored fragments; 0: what the device can bind
    float min_transmittance = 0;  ///< a pixel is done where less gets through; 0: only what nothing can change
    bool audit = false;           ///< keep how many fragments each pixel composited, and composite them all
};

/// `hdr = Σ T_i a_i L_i + T hdr` over all fragments of a pixel, front to back (Porter and Duff 1984), in linear HDR and
/// single precision; equal depth: the later primitive is in front.  Two geometry passes: LayerCountPass counts,
/// FragmentLists stores every fragment in a place of its own; a compute pass sorts and composites each pixel.
/// Nothing is ever dropped: where the fragments exceed the budget the picture is made in bands of rows, the same bits.
/// With `min_transmittance` t > 0 the error of a pixel is at most t times the largest radiance behind.
/// Shaders: shaders/abuffer.
template <rhi::Backend B>
class AbufferPass {
public:
    /// `hdr`: rgba16_float `[h, w]`, storage.  `counts`: LayerCountPass::counts().  Errors: those of creation.
    [[nodiscard]] static Result<AbufferPass> create(typename B::Device& device, const AbufferDesc& desc,
                                                    rhi::Texture hdr, rhi::Texture counts);

    /// Once the counts are on the CPU: decides the bands and makes room.  Errors: those of `split_strips`, of memory.
    [[nodiscard]] Result<void> prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips);

    /// Records everything from the counts to the picture, in the bands of the last `prepare`.  The depth test is
    /// greater-or-equal against `depth`, which is read only.  Precondition: no pass is open.
    void record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                std::span<const DrawItem> items) const;

    [[nodiscard]] std::size_t bands() const { return lists_.bands().size(); }
    [[nodiscard]] std::uint64_t pool_bytes() const { return lists_.bytes(); }
    /// r32_uint `[h, w]`: fragments composited in each pixel; 1 × 1 unless `audit`.
    [[nodiscard]] rhi::Texture composited() const { return audit_; }
    /// Calls `visit(name, bytes)` for each buffer and texture that the pass owns.
    template <class F>
    void each_resource(F&& visit) const {
        lists_.each_resource(visit);
        const Extent2D size = desc_.audit ? desc_.fragments.size : Extent2D{1, 1};
        visit("abuffer.audit", std::uint64_t{4} * size.width * size.height);
    }

private:
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device, const rhi::GroupLayout& layout);

    AbufferDesc desc_;
    rhi::Texture hdr_ = {};
    FragmentLists<B> lists_;
    rhi::Unique<typename B::Device, rhi::Texture> audit_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> resolve_[PELLUCID_LISTS_CLASS_COUNT];
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<AbufferPass<B>> AbufferPass<B>::create(typename B::Device& device, const AbufferDesc& desc, rhi::Texture hdr,
                                              rhi::Texture counts) {
    AbufferPass pass;
    pass.desc_ = desc;
    pass.hdr_ = hdr;
    PELLUCID_TRY(pass.lists_,
                 FragmentLists<B>::create(
                     device,
                     {.fragments = desc.fragments,
                      .content = desc.content,
                      .memory_budget = desc.memory_budget,
                      .visit_turns = desc.content == FragmentContent::surfaces ? 1 + desc.fragments.lights : 0},
                     counts));
    // A binding that is not used still wants an image.
    PELLUCID_OWN(pass.audit_, device,
                 device.make_texture({.size = desc.audit ? desc.fragments.size : Extent2D{1, 1},
                                      .format = rhi::Format::r32_uint,
                                      .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source |
                                               rhi::TextureUsage::attachment,
                                      .debug_name = "abuffer.audit"}));
    PELLUCID_CHECK(pass.make_pipelines(
        device,
        pass.lists_
            .walker_group({{PELLUCID_ABUFFER_TARGET, hdr}, {PELLUCID_ABUFFER_AUDIT, pass.audit_}}, {}, {}, "abuffer")
            .layout));
    return pass;
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::make_pipelines(typename B::Device& device, const rhi::GroupLayout& layout) {
    using namespace shaders;
    const rhi::Shader* const colors[] = {&abuffer_resolve_4_comp, &abuffer_resolve_8_comp, &abuffer_resolve_16_comp,
                                         &abuffer_resolve_deep_comp};
    const rhi::Shader* const lit[2][2] = {{&abuffer_lit_8_comp, &abuffer_lit_deep_comp},
                                          {&abuffer_lit_8_comp_exact, &abuffer_lit_deep_comp_exact}};
    const bool surfaces = lists_.lit_later();
    const auto shading = desc_.fragments.constants();
    const rhi::SpecConstant constants[] = {
        shading[0], shading[1], {2, desc_.audit ? 1u : 0u}, walk_constant(device.info())};
    for (std::uint32_t c = 0; c < PELLUCID_LISTS_CLASS_COUNT; c += surfaces ? 2 : 1) {
        PELLUCID_OWN(resolve_[c], device,
                     device.make_pipeline(rhi::ComputePipelineDesc{
                         .compute = surfaces ? lit[desc_.fragments.exact ? 1 : 0][c / 2] : colors[c],
                         .constants = constants,
                         .pass_group = layout,
                         .scene_group = surfaces ? scene_group_layout() : rhi::GroupLayout{},
                         .push_bytes = sizeof(gpu::ListBand),
                         .debug_name = "abuffer.resolve"}));
    }
    return {};
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::prepare(typename B::Device& device, std::span<const gpu::LayerStrip> strips) {
    PELLUCID_TRY(const bool made, lists_.prepare(device, strips));
    if (!made) return {};
    PELLUCID_OWN(group_, device,
                 device.make_group(lists_.walker_group(
                     {{PELLUCID_ABUFFER_TARGET, hdr_}, {PELLUCID_ABUFFER_AUDIT, audit_}}, {}, {}, "abuffer")));
    return {};
}

template <rhi::Backend B>
void AbufferPass<B>::record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                            std::span<const DrawItem> items) const {
    using enum rhi::Access;
    if (desc_.audit) {
        cmd.begin_render({.colors = {{.texture = audit_}}, .size = desc_.fragments.size, .name = "abuffer.audit"});
        cmd.end_render();
    }
    const rhi::Pipeline pipelines[] = {resolve_[0], resolve_[1], resolve_[2], resolve_[3]};
    for (const StripBand& band : lists_.bands()) {
        lists_.record(cmd, band, depth, scene, items);
        lists_.walk(cmd, band, scene, {rhi::use(hdr_, storage_read_write), rhi::use(audit_, storage_write)}, pipelines,
                    group_, desc_.audit ? -1.0f : desc_.min_transmittance, "abuffer.resolve");
    }
}

}  // namespace pellucid
