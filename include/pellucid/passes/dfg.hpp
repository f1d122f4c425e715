// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The directional albedo of the specular lobe as a texture, computed once on the device: what `Brdf::conserving` and
/// image-based light look up.  Formulae, layout and errors: reference/dfg.hpp, reference/dfg_table.hpp.
#include <pellucid/gpu/dfg.h>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/dfg.hpp>

namespace pellucid::inline v0_1 {

/// Fills a `[128, 128]` rgba16_float texture with loss, shift and the row's averages.
template <rhi::Backend B>
class DfgPass {
public:
    /// What `table` must be.
    [[nodiscard]] static constexpr rhi::TextureDesc table_desc() {
        return {.size = {PELLUCID_DFG_SIZE, PELLUCID_DFG_SIZE},
                .format = rhi::Format::rgba16_float,
                .usage = rhi::TextureUsage::storage | rhi::TextureUsage::sampled | rhi::TextureUsage::copy_source,
                .debug_name = "scene.dfg"};
    }
    /// Errors: those of pipeline and group creation.
    [[nodiscard]] static Result<DfgPass> create(typename B::Device& device, rhi::Texture table) {
        DfgPass pass;
        pass.table_ = table;
        const rhi::GroupLayout layout{{{PELLUCID_DFG_TABLE, rhi::BindingKind::storage_texture}}};
        PELLUCID_OWN(pass.group_, device,
                     device.make_group({.layout = layout,
                                        .bindings = {{.binding = PELLUCID_DFG_TABLE, .texture = table}},
                                        .debug_name = "dfg"}));
        PELLUCID_OWN(pass.pipeline_, device,
                     device.make_pipeline(rhi::ComputePipelineDesc{
                         .compute = &shaders::dfg_comp, .pass_group = layout, .debug_name = "dfg"}));
        return pass;
    }
    /// Records one pass that writes all of the table.  Precondition: no pass is open.
    void record(typename B::Commands& cmd) const {
        cmd.begin_compute({.uses = {rhi::use(table_, rhi::Access::storage_write)}, .name = "dfg"});
        cmd.bind_pipeline(pipeline_);
        cmd.bind_group(group_);
        cmd.dispatch(PELLUCID_DFG_SIZE, 1, 1);
        cmd.end_compute();
    }

private:
    rhi::Texture table_ = {};
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
};

}  // namespace pellucid::inline v0_1
