// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the methods that list fragments share: the lists, and what composites them over the picture.
#include <pellucid/gpu/list_compositor.h>
#include <pellucid/passes/fragment_lists.hpp>

namespace pellucid::inline v0_1 {

/// The lists, and where a pixel ends.
struct ListCompositorDesc {
    FragmentListsDesc lists = {};
    float min_transmittance = 0;  ///< a pixel is done where no more gets through; 0: only what nothing can change
    bool audit = false;           ///< keep what the method tallies in each pixel, and composite all fragments
};

/// `hdr = Σ T_i c_i + T hdr` over the fragments of each pixel, front to back (Porter and Duff 1984), in single
/// precision; equal depth: the later primitive is in front.  The method's shaders include
/// shaders/common/list_compositor.glsl and say what the colour of a fragment is.
template <rhi::Backend B>
class ListCompositor {
public:
    using Pipelines = rhi::Unique<typename B::Device, rhi::Pipeline>[PELLUCID_LISTS_CLASS_COUNT];

    /// `hdr`: rgba16_float `[h, w]`, storage.  `counts`: LayerCountPass::counts().  Errors: those of creation.
    [[nodiscard]] static Result<ListCompositor> create(typename B::Device& device, const ListCompositorDesc& desc,
                                                       rhi::Texture hdr, rhi::Texture counts);

    /// The pass group of its shaders, with sampled textures of the method's own.
    [[nodiscard]] rhi::GroupDesc group(const SmallVector<BoundTexture, 8>& textures, rhi::Sampler sampler,
                                       const char* debug_name) const {
        return lists_.walker_group({{PELLUCID_COMPOSITOR_TARGET, hdr_}, {PELLUCID_COMPOSITOR_AUDIT, audit_}}, textures,
                                   sampler, debug_name);
    }
    /// Constants of the pipelines.
    [[nodiscard]] std::array<rhi::SpecConstant, 4> constants(const rhi::DeviceInfo& device) const {
        const auto shading = desc_.lists.fragments.constants();
        return {shading[0], shading[1], rhi::SpecConstant{2, desc_.audit ? 1u : 0u}, walk_constant(device)};
    }

    /// Once a frame, before the first band.  Precondition: no pass is open.
    void begin(typename B::Commands& cmd, const char* name) const;
    /// Records the compositing of one band that is in the lists.  `textures`: those of `group`.
    void record(typename B::Commands& cmd, const StripBand& band, const SceneBinding& scene,
                std::span<const rhi::Texture> textures, const Pipelines& pipelines, rhi::Group group,
                const char* name) const;

    [[nodiscard]] FragmentLists<B>& lists() { return lists_; }
    [[nodiscard]] const FragmentLists<B>& lists() const { return lists_; }
    /// r32_uint `[h, w]`: what the method tallies in each pixel; 1 × 1 unless `audit`.
    [[nodiscard]] rhi::Texture audit() const { return audit_; }
    /// Calls `visit(name, bytes)` for each buffer and texture, the lists' too.
    template <class F>
    void each_resource(F&& visit) const {
        lists_.each_resource(visit);
        visit("list_compositor.audit", std::uint64_t{4} * audit_size().width * audit_size().height);
    }

private:
    [[nodiscard]] Extent2D audit_size() const { return desc_.audit ? desc_.lists.fragments.size : Extent2D{1, 1}; }

    ListCompositorDesc desc_;
    rhi::Texture hdr_ = {};
    FragmentLists<B> lists_;
    rhi::Unique<typename B::Device, rhi::Texture> audit_;
};

// ------------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<ListCompositor<B>> ListCompositor<B>::create(typename B::Device& device, const ListCompositorDesc& desc,
                                                    rhi::Texture hdr, rhi::Texture counts) {
    using enum rhi::TextureUsage;
    ListCompositor compositor;
    compositor.desc_ = desc;
    compositor.hdr_ = hdr;
    PELLUCID_TRY(compositor.lists_, FragmentLists<B>::create(device, desc.lists, counts));
    // A binding that is not used still wants an image.
    PELLUCID_OWN(compositor.audit_, device,
                 device.make_texture({.size = compositor.audit_size(),
                                      .format = rhi::Format::r32_uint,
                                      .usage = storage | copy_source | attachment,
                                      .debug_name = "list_compositor.audit"}));
    return compositor;
}

template <rhi::Backend B>
void ListCompositor<B>::begin(typename B::Commands& cmd, const char* name) const {
    if (!desc_.audit) return;
    cmd.begin_render({.colors = {{.texture = audit_}}, .size = audit_size(), .name = name});
    cmd.end_render();
}

template <rhi::Backend B>
void ListCompositor<B>::record(typename B::Commands& cmd, const StripBand& band, const SceneBinding& scene,
                               std::span<const rhi::Texture> textures, const Pipelines& pipelines, rhi::Group group,
                               const char* name) const {
    using enum rhi::Access;
    rhi::Uses uses{rhi::use(hdr_, storage_read_write), rhi::use(audit_, storage_write)};
    for (const rhi::Texture t : textures) uses.push_back(rhi::use(t, sampled));
    const rhi::Pipeline each[] = {pipelines[0], pipelines[1], pipelines[2], pipelines[3]};
    lists_.walk(cmd, band, scene, uses, each, group, desc_.audit ? -1.0f : desc_.min_transmittance, name);
}

}  // namespace pellucid::inline v0_1
