// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Step 3 of 4: a pass of one's own, written against the concepts of rhi/backend.hpp alone, so it runs on every
/// backend.
#include "edges.h"
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/edges.hpp>  // made by pellucid_add_shader(target edges FILES edges.comp)

namespace pellucid::samples {

/// Draws lines over a picture where the depth bends.
template <rhi::Backend B>
class EdgesPass {
public:
    /// `picture`: display codes, sampled; `depth`: d32_float, sampled; both `size`, at least 3x3, and alive as
    /// long as the pass.
    /// Errors: those of creation.
    [[nodiscard]] static Result<EdgesPass> create(typename B::Device& device, rhi::Texture picture, rhi::Texture depth,
                                                  Extent2D size) {
        using enum rhi::BindingKind;
        EdgesPass pass;
        pass.picture_ = picture;
        pass.depth_ = depth;
        pass.size_ = size;
        // PELLUCID_OWN keeps what was made in a handle that destroys it, or returns the error.
        PELLUCID_OWN(pass.target_, device,
                     device.make_texture({.size = size,
                                          .format = rhi::Format::rgba8_unorm,
                                          .usage = rhi::TextureUsage::storage | rhi::TextureUsage::copy_source,
                                          .debug_name = "edges"}));
        PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler("edges")));
        // A group is what the shader sees, by the numbers of edges.h; a pipeline is the shader and the group's shape.
        const rhi::GroupLayout layout{
            {{EDGES_OUTPUT, storage_texture}, {EDGES_PICTURE, sampled_texture}, {EDGES_DEPTH, sampled_texture}}};
        PELLUCID_OWN(
            pass.group_, device,
            device.make_group({.layout = layout,
                               .bindings = {{.binding = EDGES_OUTPUT, .texture = pass.target_},
                                            {.binding = EDGES_PICTURE, .texture = picture, .sampler = pass.sampler_},
                                            {.binding = EDGES_DEPTH, .texture = depth, .sampler = pass.sampler_}},
                               .debug_name = "edges"}));
        PELLUCID_OWN(pass.pipeline_, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{.compute = &shaders::edges_comp,
                                                                   .pass_group = layout,
                                                                   .push_bytes = sizeof(gpu::Edges),
                                                                   .debug_name = "edges"}));
        return pass;
    }

    /// Records one compute pass.  Barriers follow from its uses: what is not declared is not waited for.
    /// Precondition: no pass is open.
    void record(typename B::Commands& cmd, const gpu::Edges& edges) const {
        cmd.begin_compute({.uses = {rhi::use(picture_, rhi::Access::sampled), rhi::use(depth_, rhi::Access::sampled),
                                    rhi::use(target_, rhi::Access::storage_write)},
                           .name = "edges"});
        cmd.bind_pipeline(pipeline_);
        cmd.bind_group(group_);
        cmd.push(rhi::bytes_of(edges));
        constexpr std::uint32_t tile = EDGES_GROUP_SIZE;
        cmd.dispatch((size_.width + tile - 1) / tile, (size_.height + tile - 1) / tile, 1);
        cmd.end_compute();
    }

    /// rgba8_unorm, the picture with its lines.
    [[nodiscard]] rhi::Texture target() const { return target_; }

private:
    rhi::Texture picture_ = {}, depth_ = {};
    Extent2D size_ = {};
    rhi::Unique<typename B::Device, rhi::Texture> target_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
};

}  // namespace pellucid::samples
