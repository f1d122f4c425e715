// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of `CreationChecks`.
#include <pellucid/gpu/bindings.h>
#include <pellucid/core/config.hpp>
#include <pellucid/rhi/validated/checks.hpp>

namespace pellucid::inline v0_1::validated {

/// The (group, binding) pairs that a module declares, from its OpDecorate instructions (SPIR-V specification, §3.32.3).
PELLUCID_INLINE std::vector<ShaderBinding> shader_bindings(std::span<const std::uint32_t> spirv) {
    constexpr std::uint32_t op_decorate = 71, binding = 33, descriptor_set = 34, header_words = 5;
    struct Found {
        std::uint32_t id = 0;
        ShaderBinding at = {};
        int halves = 0;
    };
    std::vector<Found> found;
    for (std::size_t i = header_words; i < spirv.size();) {
        const std::uint32_t words = spirv[i] >> 16u;
        if (words == 0 || i + words > spirv.size()) break;
        if ((spirv[i] & 0xFFFFu) == op_decorate && words == 4 &&
            (spirv[i + 2] == binding || spirv[i + 2] == descriptor_set)) {
            Found* entry = nullptr;
            for (Found& f : found)
                if (f.id == spirv[i + 1]) entry = &f;
            if (!entry) entry = &found.emplace_back(Found{.id = spirv[i + 1]});
            (spirv[i + 2] == binding ? entry->at.binding : entry->at.group) = spirv[i + 3];
            ++entry->halves;
        }
        i += words;
    }
    std::vector<ShaderBinding> out;
    for (const Found& f : found)
        if (f.halves == 2) out.push_back(f.at);
    return out;
}

PELLUCID_INLINE bool CreationChecks::shader(const rhi::Shader* shader, const PipelineInfo& pipeline,
                                            PipelineInfo& out) {
    if (!shader) return true;
    for (const ShaderBinding at : shader_bindings(shader->spirv)) {
        if (at.group == 0) {
            out.reads_frame |= at.binding == PELLUCID_BIND_FRAME;
            out.reads_records |= at.binding == PELLUCID_BIND_RECORDS;
            continue;
        }
        bool listed = false;
        if (at.group < 3)
            for (const auto& layout : pipeline.groups[at.group].bindings) listed |= layout.binding == at.binding;
        if (!listed)
            return objects_->report("pipeline '", pipeline.name, "': the shader '", shader->name, "' reads binding ",
                                    at.binding, " of group ", at.group, ", which the pipeline's layout does not list");
    }
    return true;
}

PELLUCID_INLINE bool CreationChecks::pipeline(const rhi::GraphicsPipelineDesc& desc, PipelineInfo& out) {
    out.name = desc.debug_name;
    out.groups[1] = desc.pass_group;
    out.groups[2] = desc.scene_group;
    out.push_bytes = desc.push_bytes;
    for (const auto& color : desc.colors) out.colors.push_back(color.format);
    out.depth = desc.depth;
    return shader(desc.vertex, out, out) && shader(desc.fragment, out, out);
}

PELLUCID_INLINE bool CreationChecks::pipeline(const rhi::ComputePipelineDesc& desc, PipelineInfo& out) {
    out.name = desc.debug_name;
    out.compute = true;
    out.groups[1] = desc.pass_group;
    out.groups[2] = desc.scene_group;
    out.push_bytes = desc.push_bytes;
    return shader(desc.compute, out, out);
}

PELLUCID_INLINE bool CreationChecks::group(const rhi::GroupDesc& desc, rhi::GroupDesc& inner) {
    inner = desc;
    const std::string where = text("group '", desc.debug_name, "'");
    Reporter& report = objects_->report;
    if (desc.slot == rhi::GroupSlot::frame)
        return report(where, ": group 0 is the device's; use the slot pass or scene");
    for (auto& binding : inner.bindings) {
        const rhi::BindingLayout* layout = nullptr;
        for (const auto& l : desc.layout.bindings)
            if (l.binding == binding.binding) layout = &l;
        if (!layout) return report(where, ": binding ", binding.binding, " is not in its layout");
        const std::string what = text(where, ", binding ", binding.binding);
        const bool is_buffer =
            layout->kind == rhi::BindingKind::uniform_buffer || layout->kind == rhi::BindingKind::storage_buffer;
        if (is_buffer) {
            const BufferInfo* buffer = objects_->find(binding.buffer, what);
            if (!buffer) return false;
            const bool uniform = layout->kind == rhi::BindingKind::uniform_buffer;
            if (!has(buffer->usage, uniform ? rhi::BufferUsage::uniform : rhi::BufferUsage::storage))
                return report(what, ": the buffer '", buffer->name, "' lacks the usage ",
                              uniform ? "uniform" : "storage");
            binding.buffer = buffer->inner;
            continue;
        }
        const TextureInfo* texture = objects_->find(binding.texture, what);
        if (!texture) return false;
        const bool storage = layout->kind == rhi::BindingKind::storage_texture;
        if (!has(texture->desc.usage, storage ? rhi::TextureUsage::storage : rhi::TextureUsage::sampled))
            return report(what, ": the texture '", texture->name, "' lacks the usage ",
                          storage ? "storage" : "sampled");
        if (storage && binding.mip >= texture->desc.mips)
            return report(what, ": level ", binding.mip, " of the texture '", texture->name, "', which has ",
                          texture->desc.mips);
        binding.texture = texture->inner;
        if (storage) continue;
        const SamplerInfo* sampler = objects_->find(binding.sampler, what);
        if (!sampler) return false;
        binding.sampler = sampler->inner;
    }
    return true;
}

PELLUCID_INLINE bool CreationChecks::results(rhi::Queries queries, std::uint32_t first, std::size_t count) {
    const QueriesInfo* info = objects_->find(queries, "results");
    if (!info) return false;
    if (first + count <= info->count) return true;
    return objects_->report("results: queries ", first, " to ", first + count, " of the pool '", info->name,
                            "', which has ", info->count);
}

}  // namespace pellucid::inline v0_1::validated
