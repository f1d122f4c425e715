// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exact transparency of any order and depth: an A-buffer (Carpenter 1984) of exactly the size that the frame needs.
#include <pellucid/passes/list_compositor.hpp>
#include <pellucid/shaders/abuffer.hpp>

namespace pellucid::inline v0_1 {

/// What an A-buffer stores, in how much memory.
struct AbufferDesc {
    FragmentDesc fragments = {};
    FragmentContent content = FragmentContent::colors;  ///< surfaces: lit in compute, and only what is seen
    std::uint64_t memory_budget = 0;                    ///< [byte] for stored fragments; 0: what the device can bind
    float min_transmittance = 0;  ///< a pixel is done where no more gets through; 0: only what nothing can change
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

    /// Its audit: fragments composited.
    [[nodiscard]] const ListCompositor<B>& compositor() const { return compositor_; }

private:
    [[nodiscard]] Result<void> make_pipelines(typename B::Device& device, const rhi::GroupLayout& layout);

    AbufferDesc desc_;
    ListCompositor<B> compositor_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    typename ListCompositor<B>::Pipelines resolve_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<AbufferPass<B>> AbufferPass<B>::create(typename B::Device& device, const AbufferDesc& desc, rhi::Texture hdr,
                                              rhi::Texture counts) {
    AbufferPass pass;
    pass.desc_ = desc;
    PELLUCID_TRY(
        pass.compositor_,
        ListCompositor<B>::create(
            device,
            {.lists = {.fragments = desc.fragments,
                       .content = desc.content,
                       .memory_budget = desc.memory_budget,
                       .visit_turns = desc.content == FragmentContent::surfaces ? 1 + desc.fragments.lights : 0},
             .min_transmittance = desc.min_transmittance,
             .audit = desc.audit},
            hdr, counts));
    PELLUCID_CHECK(pass.make_pipelines(device, pass.compositor_.group({}, {}, "abuffer").layout));
    return pass;
}

template <rhi::Backend B>
Result<void> AbufferPass<B>::make_pipelines(typename B::Device& device, const rhi::GroupLayout& layout) {
    using namespace shaders;
    const rhi::Shader* const colors[] = {&abuffer_resolve_4_comp, &abuffer_resolve_8_comp, &abuffer_resolve_16_comp,
                                         &abuffer_resolve_deep_comp};
    const rhi::Shader* const lit[2][2] = {{&abuffer_lit_8_comp, &abuffer_lit_deep_comp},
                                          {&abuffer_lit_8_comp_exact, &abuffer_lit_deep_comp_exact}};
    const bool surfaces = compositor_.lists().lit_later();
    const auto constants = compositor_.constants(device.info());
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
    PELLUCID_TRY(const bool made, compositor_.lists().prepare(device, strips));
    if (!made) return {};
    PELLUCID_OWN(group_, device, device.make_group(compositor_.group({}, {}, "abuffer")));
    return {};
}

template <rhi::Backend B>
void AbufferPass<B>::record(typename B::Commands& cmd, rhi::Texture depth, const SceneBinding& scene,
                            std::span<const DrawItem> items) const {
    compositor_.begin(cmd, "abuffer.audit");
    for (const StripBand& band : compositor_.lists().bands()) {
        compositor_.lists().record(cmd, band, depth, scene, items);
        compositor_.record(cmd, band, scene, {}, resolve_, group_, "abuffer.resolve");
    }
}

}  // namespace pellucid::inline v0_1
