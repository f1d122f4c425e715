// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How passes are told what to draw.  The scene is bound once; a draw is an index range and the index of its record.
#include <pellucid/gpu/bindings.h>
#include <pellucid/gpu/scene.h>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/scene.hpp>
#include <span>

namespace pellucid::inline v0_1 {

/// One draw: a range of the scene's indices, and the record of the instance.
struct DrawItem {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t record = 0;          ///< index of the instance's DrawRecord
    rhi::Cull cull = rhi::Cull::back;  ///< mirrored instances cull front faces; double-sided ones none
};

/// Everything about the scene that a pass binds, the same for every pass of a frame.
struct SceneBinding {
    rhi::UniformSlice frame = {};   ///< FrameParams
    rhi::RecordSlice records = {};  ///< DrawRecord, one an instance
    rhi::Group group = {};          ///< scene_group_layout()
    rhi::Buffer indices = {};
    rhi::Uses uses = {};  ///< every resource of `group`
};

/// Shape of group 2: vertices, indices, materials, lights, their lists and shadows, texture arrays.
[[nodiscard]] constexpr rhi::GroupLayout scene_group_layout() {
    using enum rhi::BindingKind;
    rhi::GroupLayout layout{{{PELLUCID_BIND_VERTICES, storage_buffer},
                             {PELLUCID_BIND_INDICES, storage_buffer},
                             {PELLUCID_BIND_MATERIALS, storage_buffer},
                             {PELLUCID_BIND_LIGHTS, storage_buffer},
                             {PELLUCID_BIND_LIGHT_LISTS, storage_buffer},
                             {PELLUCID_BIND_LIGHT_BLOCK, uniform_buffer},
                             {PELLUCID_BIND_SHADOW_MAPS, sampled_texture},
                             {PELLUCID_BIND_SHADOWS, storage_buffer}}};
    for (std::uint32_t i = 0; i < PELLUCID_TEXTURE_ARRAYS; ++i)
        layout.bindings.push_back({PELLUCID_BIND_TEXTURES + i, sampled_texture});
    for (const std::uint32_t binding : {PELLUCID_BIND_DFG, PELLUCID_BIND_ENVIRONMENT, PELLUCID_BIND_SKY})
        layout.bindings.push_back({binding, sampled_texture});
    return layout;
}

/// A pipeline for each way of culling that a scene uses.
template <rhi::Backend B>
struct CullVariants {
    rhi::Unique<typename B::Device, rhi::Pipeline> pipelines[3];

    /// Builds the variants whose bit (1 << Cull) is set in `used`.
    [[nodiscard]] Result<void> create(typename B::Device& device, rhi::GraphicsPipelineDesc desc, std::uint32_t used) {
        for (const rhi::Cull cull : {rhi::Cull::none, rhi::Cull::back, rhi::Cull::front}) {
            if ((used >> static_cast<std::uint32_t>(cull) & 1u) == 0) continue;
            desc.cull = cull;
            PELLUCID_OWN(pipelines[static_cast<std::size_t>(cull)], device, device.make_pipeline(desc));
        }
        return {};
    }
    [[nodiscard]] rhi::Pipeline operator[](rhi::Cull cull) const { return pipelines[static_cast<std::size_t>(cull)]; }
};

/// Draws `items` in order with the scene bound, changing pipelines only where the culling changes.  `pass_group` is
/// bound too, where the pipelines have one.
template <rhi::Backend B>
void draw_items(typename B::Commands& cmd, const CullVariants<B>& variants, const SceneBinding& scene,
                std::span<const DrawItem> items, rhi::Group pass_group = {}) {
    rhi::Pipeline bound;
    for (const DrawItem& item : items) {
        if (const rhi::Pipeline wanted = variants[item.cull]; wanted != bound) {
            cmd.bind_pipeline(wanted);
            if (!bound) {
                cmd.bind_frame(scene.frame, scene.records);
                if (pass_group) cmd.bind_group(pass_group);
                cmd.bind_group(scene.group);
                cmd.bind_index_buffer(scene.indices);
            }
            bound = wanted;
        }
        cmd.draw_indexed({.index_count = item.index_count,
                          .first_index = item.first_index,
                          .vertex_offset = item.vertex_offset,
                          .first_instance = scene.records.first + item.record});
    }
}

}  // namespace pellucid::inline v0_1
