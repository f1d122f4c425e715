// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of `RecordingChecks`: what is bound, and the work that reads it.
#include <pellucid/core/config.hpp>
#include <pellucid/rhi/validated/checks.hpp>

namespace pellucid::inline v0_1::validated {

/// Whether the pass declares this use of a buffer or a texture.
template <class H>
bool RecordingChecks::declared(H resource, rhi::Access access) const {
    for (const auto& use : uses_) {
        if (use.access != access) continue;
        if constexpr (std::is_same_v<H, rhi::Buffer>) {
            if (!use.texture && use.buffer == resource) return true;
        } else {
            if (use.texture == resource) return true;
        }
    }
    return false;
}

/// Whether the pass declares a use that fits a binding of this kind.
template <class H>
bool RecordingChecks::declared_for(H resource, rhi::BindingKind kind) const {
    using enum rhi::Access;
    switch (kind) {
        case rhi::BindingKind::uniform_buffer:
            return declared(resource, uniform_read);
        case rhi::BindingKind::sampled_texture:
            return declared(resource, sampled);
        case rhi::BindingKind::storage_buffer:
        case rhi::BindingKind::storage_texture:
            break;
    }
    return declared(resource, storage_read) || declared(resource, storage_write) ||
           declared(resource, storage_read_write);
}

PELLUCID_INLINE bool RecordingChecks::bind_pipeline(rhi::Pipeline pipeline) {
    const PipelineInfo* info = objects_->find(pipeline, where("bind_pipeline"));
    if (!info) return false;
    if (!inside(info->compute ? Pass::compute : Pass::render, "bind_pipeline")) return false;
    if (!info->compute && !attachments_match(*info, where("bind_pipeline"))) return false;
    // Groups stay bound while the layouts stay the same; a change of one also drops those behind it.
    const PipelineInfo* last = pipeline_ ? objects_->pipelines.find(pipeline_) : nullptr;
    bool same = true;
    for (int slot = 1; last && slot < 3; ++slot) {
        same = same && last->groups[slot] == info->groups[slot];
        if (!same) groups_[slot] = {};
    }
    pipeline_ = pipeline;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::attachments_match(const PipelineInfo& pipeline, const std::string& what) {
    Reporter& report = objects_->report;
    if (pipeline.colors.size() != render_.colors.size())
        return report(what, ": the pipeline '", pipeline.name, "' writes ", pipeline.colors.size(),
                      " colours, the pass attaches ", render_.colors.size());
    for (std::size_t i = 0; i < pipeline.colors.size(); ++i) {
        const auto format = objects_->textures.find(render_.colors[i].texture)->desc.format;
        if (format != pipeline.colors[i])
            return report(what, ": colour ", i, " of the pipeline '", pipeline.name, "' is ",
                          rhi::info(pipeline.colors[i]).name, ", the attachment is ", rhi::info(format).name);
    }
    const TextureInfo* depth = render_.depth.texture ? objects_->textures.find(render_.depth.texture) : nullptr;
    const auto format = depth ? depth->desc.format : rhi::Format::undefined;
    if (format != pipeline.depth.format)
        return report(what, ": the depth format of the pipeline '", pipeline.name, "' is ",
                      rhi::info(pipeline.depth.format).name, ", the attachment's is ", rhi::info(format).name);
    if (depth && render_.depth.read_only && pipeline.depth.write)
        return report(what, ": the pipeline '", pipeline.name, "' writes depth, but '", depth->name, "' is read-only");
    return true;
}

PELLUCID_INLINE bool RecordingChecks::bind_group(rhi::Group group) {
    if (pass_ != Pass::compute && !inside(Pass::render, "bind_group")) return false;
    if (refused_) return false;
    const std::string what = where("bind_group");
    Reporter& report = objects_->report;
    const GroupInfo* info = objects_->find(group, what);
    if (!info) return false;
    const PipelineInfo* pipeline = pipeline_ ? objects_->pipelines.find(pipeline_) : nullptr;
    if (!pipeline) return report(what, ": no pipeline is bound; bind it before the group '", info->name, "'");
    const auto slot = static_cast<std::size_t>(info->desc.slot);
    if (!(pipeline->groups[slot] == info->desc.layout))
        return report(what, ": the group '", info->name, "' has ", info->desc.layout.bindings.size(),
                      " bindings of another layout than the ", pipeline->groups[slot].bindings.size(),
                      " that the pipeline '", pipeline->name, "' has in slot ", slot);
    for (const auto& layout : info->desc.layout.bindings) {
        for (const auto& binding : info->desc.bindings) {
            if (binding.binding != layout.binding) continue;
            const std::string at = text(what, ", the group '", info->name, "', binding ", binding.binding);
            if (layout.kind == rhi::BindingKind::uniform_buffer || layout.kind == rhi::BindingKind::storage_buffer) {
                const BufferInfo* buffer = objects_->find(binding.buffer, at);
                if (!buffer) return false;
                const bool needed = buffer->written || layout.kind == rhi::BindingKind::storage_buffer;
                if (needed && !declared_for(binding.buffer, layout.kind))
                    return report(at, ": the pass does not declare its use of the buffer '", buffer->name, "'");
            } else {
                const TextureInfo* texture = objects_->find(binding.texture, at);
                if (!texture) return false;
                bool read_only = false;
                if (attached(binding.texture, read_only) && !read_only)
                    return report(at, ": the texture '", texture->name, "' is attached to the pass");
                if (!declared_for(binding.texture, layout.kind))
                    return report(at, ": the pass does not declare its use of the texture '", texture->name, "'");
            }
        }
    }
    groups_[slot] = group;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::bind_frame(const rhi::UniformSlice& uniforms, const rhi::RecordSlice& records) {
    if (pass_ != Pass::compute && !inside(Pass::render, "bind_frame")) return false;
    if (refused_) return false;
    bool known = false;
    for (const auto& slice : uniforms_) known |= slice.block == uniforms.block && slice.offset == uniforms.offset;
    const bool given = uniforms.block != 0 || uniforms.offset != 0;
    if (given && !known)
        return objects_->report(where("bind_frame"), ": the uniforms at block ", uniforms.block, ", byte ",
                                uniforms.offset, " were not uploaded in this frame");
    frame_bound_ = known;
    known = records.bytes.empty();
    for (const auto& slice : records_) known |= slice.block == records.block && slice.first == records.first;
    if (!known)
        return objects_->report(where("bind_frame"), ": the records from ", records.first, " in block ", records.block,
                                " were not uploaded in this frame");
    records_bound_ = !records.bytes.empty();
    return true;
}

PELLUCID_INLINE bool RecordingChecks::bind_index_buffer(rhi::Buffer indices) {
    if (!inside(Pass::render, "bind_index_buffer")) return false;
    const std::string what = where("bind_index_buffer");
    const BufferInfo* buffer = objects_->find(indices, what);
    if (!buffer) return false;
    if (!has(buffer->usage, rhi::BufferUsage::index))
        return objects_->report(what, ": the buffer '", buffer->name, "' lacks the usage index");
    if (buffer->written && !declared(indices, rhi::Access::index_read))
        return objects_->report(what, ": the pass does not declare index_read of the buffer '", buffer->name, "'");
    indices_ = indices;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::push(std::size_t bytes) {
    if (pass_ != Pass::compute && !inside(Pass::render, "push")) return false;
    if (refused_) return false;
    const PipelineInfo* pipeline = pipeline_ ? objects_->pipelines.find(pipeline_) : nullptr;
    if (!pipeline) return objects_->report(where("push"), ": no pipeline is bound");
    if (bytes != pipeline->push_bytes)
        return objects_->report(where("push"), ": ", bytes, " bytes; the pipeline '", pipeline->name, "' takes ",
                                pipeline->push_bytes);
    pushed_ = bytes;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::set_scissor(rhi::Rect rect) {
    if (!inside(Pass::render, "set_scissor")) return false;
    const std::uint64_t right = std::uint64_t{rect.x} + rect.width, bottom = std::uint64_t{rect.y} + rect.height;
    if (right <= render_.size.width && bottom <= render_.size.height) return true;
    return objects_->report(where("set_scissor"), ": the rectangle ends at ", right, ", ", bottom,
                            ", the render area at ", render_.size.width, ", ", render_.size.height);
}

PELLUCID_INLINE bool RecordingChecks::set_stencil_reference() {
    return inside(Pass::render, "set_stencil_reference");
}

PELLUCID_INLINE bool RecordingChecks::work(Pass kind, const char* call) {
    if (!inside(kind, call)) return false;
    const std::string what = where(call);
    Reporter& report = objects_->report;
    if (!pipeline_) return report(what, ": no pipeline is bound");
    const PipelineInfo* pipeline = objects_->find(pipeline_, what);
    if (!pipeline || !bound_groups(*pipeline, what)) return false;
    if (pipeline->reads_frame && !frame_bound_)
        return report(what, ": the pipeline '", pipeline->name, "' reads the frame's uniforms, and none are bound");
    if (pipeline->reads_records && !records_bound_)
        return report(what, ": the pipeline '", pipeline->name, "' reads the frame's records, and none are bound");
    if (pipeline->push_bytes > pushed_)
        return report(what, ": the pipeline '", pipeline->name, "' reads ", pipeline->push_bytes,
                      " bytes of push data, and ", pushed_, " were pushed");
    return true;
}

PELLUCID_INLINE bool RecordingChecks::bound_groups(const PipelineInfo& pipeline, const std::string& what) {
    for (std::size_t slot = 1; slot < 3; ++slot) {
        if (pipeline.groups[slot].bindings.empty()) continue;
        if (!groups_[slot])
            return objects_->report(what, ": the pipeline '", pipeline.name, "' needs a group of ",
                                    pipeline.groups[slot].bindings.size(), " bindings in slot ", slot,
                                    ", and none is bound");
        if (!objects_->find(groups_[slot], what)) return false;
    }
    return true;
}

PELLUCID_INLINE bool RecordingChecks::draw(const rhi::Draw& draw) {
    if (!work(Pass::render, "draw")) return false;
    if (draw.vertex_count != 0 && draw.instance_count != 0) return true;
    return objects_->report(where("draw"), ": ", draw.vertex_count, " vertices of ", draw.instance_count, " instances");
}

PELLUCID_INLINE bool RecordingChecks::index_range(const std::string& what, std::uint64_t first, std::uint64_t count) {
    if (!indices_) return objects_->report(what, ": no index buffer is bound");
    const BufferInfo* buffer = objects_->find(indices_, what);
    if (!buffer) return false;
    if (first + count <= buffer->size / 4) return true;
    return objects_->report(what, ": indices ", first, " to ", first + count, " of the buffer '", buffer->name,
                            "', which has ", buffer->size / 4);
}

PELLUCID_INLINE bool RecordingChecks::draw_indexed(const rhi::DrawIndexed& draw) {
    if (!work(Pass::render, "draw_indexed")) return false;
    const std::string what = where("draw_indexed");
    if (draw.index_count == 0 || draw.instance_count == 0)
        return objects_->report(what, ": ", draw.index_count, " indices of ", draw.instance_count, " instances");
    return index_range(what, draw.first_index, draw.index_count);
}

PELLUCID_INLINE bool RecordingChecks::arguments(rhi::Buffer buffer, std::uint64_t offset, std::uint64_t bytes,
                                                const std::string& what) {
    const BufferInfo* info = objects_->find(buffer, what);
    if (!info) return false;
    Reporter& report = objects_->report;
    if (!has(info->usage, rhi::BufferUsage::indirect))
        return report(what, ": the buffer '", info->name, "' lacks the usage indirect");
    if (info->written && !declared(buffer, rhi::Access::indirect_read))
        return report(what, ": the pass does not declare indirect_read of the buffer '", info->name, "'");
    if (offset % 4 != 0) return report(what, ": the offset ", offset, " is no multiple of 4");
    if (offset > info->size || bytes > info->size - offset)
        return report(what, ": ", bytes, " bytes at ", offset, " of the buffer '", info->name, "', which has ",
                      info->size);
    return true;
}

PELLUCID_INLINE bool RecordingChecks::draw_indexed_indirect(rhi::Buffer buffer, std::uint64_t offset,
                                                            std::uint32_t count) {
    if (!work(Pass::render, "draw_indexed_indirect")) return false;
    const std::string what = where("draw_indexed_indirect");
    if (count == 0) return objects_->report(what, ": 0 draws");
    return index_range(what, 0, 0) && arguments(buffer, offset, std::uint64_t{count} * sizeof(rhi::DrawIndexed), what);
}

PELLUCID_INLINE bool RecordingChecks::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (!work(Pass::compute, "dispatch")) return false;
    constexpr std::uint32_t limit = 65535;  // of both APIs, on every device
    if (x - 1u < limit && y - 1u < limit && z - 1u < limit) return true;
    return objects_->report(where("dispatch"), ": ", x, "x", y, "x", z, " groups; each must be 1 to ", limit);
}

PELLUCID_INLINE bool RecordingChecks::dispatch_indirect(rhi::Buffer buffer, std::uint64_t offset) {
    return work(Pass::compute, "dispatch_indirect") && arguments(buffer, offset, 12, where("dispatch_indirect"));
}

}  // namespace pellucid::inline v0_1::validated
