// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of `RecordingChecks`: frames, passes, their attachments and declared uses, queries.
#include <algorithm>
#include <bit>
#include <pellucid/core/config.hpp>
#include <pellucid/rhi/validated/checks.hpp>

namespace pellucid::inline v0_1::validated {

PELLUCID_INLINE std::string RecordingChecks::where(const char* call) const {
    return pass_ == Pass::none ? std::string(call) : text(call, " in the pass '", name_, "'");
}

PELLUCID_INLINE bool RecordingChecks::begin_frame() {
    if (recording_) return objects_->report("begin_frame: the last frame was not submitted");
    recording_ = true;
    uniforms_.clear();
    records_.clear();
    return true;
}

PELLUCID_INLINE bool RecordingChecks::submit() {
    if (!recording_) return objects_->report("submit: no frame was begun");
    if (pass_ != Pass::none) {
        objects_->report("submit: the pass '", name_, "' has not ended");
        return false;
    }
    recording_ = false;
    return true;
}

template <class Desc>
bool RecordingChecks::begin(Pass kind, const Desc& desc, Desc& inner) {
    if (!recording_) return objects_->report("the pass '", desc.name, "' begins outside a frame");
    if (pass_ != Pass::none)
        return objects_->report("the pass '", desc.name, "' begins inside the pass '", name_, "'; passes do not nest");
    pass_ = kind;
    name_ = desc.name;
    refused_ = false;
    inner = desc;
    uses_ = desc.uses;
    pipeline_ = {};
    for (auto& group : groups_) group = {};
    frame_bound_ = records_bound_ = false;
    pushed_ = 0;
    indices_ = {};
    refused_ = !uses(desc.uses, inner.uses);
    return !refused_;
}

PELLUCID_INLINE bool RecordingChecks::begin(const rhi::RenderPassDesc& desc, rhi::RenderPassDesc& inner) {
    if (pass_ != Pass::none || !recording_) return begin(Pass::render, desc, inner);
    render_ = desc;
    bool good = begin(Pass::render, desc, inner);
    const std::string what = where("begin_render");
    if (desc.size.width == 0 || desc.size.height == 0)
        good = objects_->report(what, ": the render area is ", desc.size.width, "x", desc.size.height);
    for (std::size_t i = 0; good && i < desc.colors.size(); ++i)
        good = attachment(desc.colors[i].texture, desc.colors[i].mip, desc.colors[i].layer, desc.size, false,
                          inner.colors[i].texture);
    if (good && desc.depth.texture)
        good = attachment(desc.depth.texture, desc.depth.mip, desc.depth.layer, desc.size, true, inner.depth.texture);
    good = good && attached_once();
    for (std::size_t i = 0; good && i < desc.uses.size(); ++i) {
        bool read_only = false;
        if (!desc.uses[i].texture || !attached(desc.uses[i].texture, read_only)) continue;
        if (!read_only || desc.uses[i].access != rhi::Access::sampled)
            good = objects_->report(what, ": the texture '", objects_->textures.find(desc.uses[i].texture)->name,
                                    "' is attached and declared as used; only read-only depth may be sampled too");
    }
    if (good) {
        for (const auto& color : desc.colors) objects_->textures.find(color.texture)->written = true;
        if (desc.depth.texture) objects_->textures.find(desc.depth.texture)->written = true;
    }
    refused_ = !good;
    return good;
}
PELLUCID_INLINE bool RecordingChecks::begin(const rhi::ComputePassDesc& desc, rhi::ComputePassDesc& inner) {
    return begin(Pass::compute, desc, inner);
}
PELLUCID_INLINE bool RecordingChecks::begin(const rhi::CopyPassDesc& desc, rhi::CopyPassDesc& inner) {
    return begin(Pass::copy, desc, inner);
}

PELLUCID_INLINE bool RecordingChecks::end(Pass kind) {
    constexpr const char* calls[] = {"", "end_render", "end_compute", "end_copy"};
    const char* call = calls[static_cast<int>(kind)];
    if (pass_ == Pass::none) return objects_->report(call, ": no pass was begun");
    if (pass_ != kind) return objects_->report(where(call), ": the pass is of another kind");
    pass_ = Pass::none;
    return !refused_;
}

PELLUCID_INLINE bool RecordingChecks::inside(Pass kind, const char* call) {
    constexpr const char* kinds[] = {"any pass", "a render pass", "a compute pass", "a copy pass"};
    if (pass_ != kind || !recording_) {
        if (pass_ != Pass::none && refused_) return false;  // said already
        return objects_->report(where(call), ": it belongs inside ", kinds[static_cast<int>(kind)]);
    }
    return !refused_;
}

PELLUCID_INLINE bool RecordingChecks::uses(const rhi::Uses& uses, rhi::Uses& inner) {
    using enum rhi::Access;
    constexpr const char* names[] = {"sampled",       "uniform_read",       "storage_read",
                                     "storage_write", "storage_read_write", "index_read",
                                     "indirect_read", "copy_read",          "copy_write"};
    constexpr rhi::BufferUsage for_buffers[] = {
        rhi::BufferUsage::none,     rhi::BufferUsage::uniform,     rhi::BufferUsage::storage,
        rhi::BufferUsage::storage,  rhi::BufferUsage::storage,     rhi::BufferUsage::index,
        rhi::BufferUsage::indirect, rhi::BufferUsage::copy_source, rhi::BufferUsage::copy_destination};
    constexpr rhi::TextureUsage for_textures[] = {
        rhi::TextureUsage::sampled, rhi::TextureUsage::none,        rhi::TextureUsage::storage,
        rhi::TextureUsage::storage, rhi::TextureUsage::storage,     rhi::TextureUsage::none,
        rhi::TextureUsage::none,    rhi::TextureUsage::copy_source, rhi::TextureUsage::copy_destination};
    const std::string what = text("the uses of the pass '", name_, "'");
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const auto& use = uses[i];
        const auto access = static_cast<std::size_t>(use.access);
        const bool writes = use.access == storage_write || use.access == storage_read_write || use.access == copy_write;
        if (use.texture) {
            TextureInfo* texture = objects_->find(use.texture, what);
            if (!texture) return false;
            if (for_textures[access] == rhi::TextureUsage::none || !has(texture->desc.usage, for_textures[access]))
                return objects_->report(what, ": the texture '", texture->name, "' was not made for ", names[access]);
            texture->written |= writes;
            inner[i].texture = texture->inner;
        } else {
            BufferInfo* buffer = objects_->find(use.buffer, what);
            if (!buffer) return false;
            if (for_buffers[access] == rhi::BufferUsage::none || !has(buffer->usage, for_buffers[access]))
                return objects_->report(what, ": the buffer '", buffer->name, "' was not made for ", names[access]);
            buffer->written |= writes;
            inner[i].buffer = buffer->inner;
        }
    }
    return true;
}

PELLUCID_INLINE bool RecordingChecks::attachment(rhi::Texture texture, std::uint32_t mip, std::uint32_t layer,
                                                 Extent2D size, bool depth, rhi::Texture& inner) {
    const std::string what = where("begin_render");
    Reporter& report = objects_->report;
    const TextureInfo* info = objects_->find(texture, what);
    if (!info) return false;
    const rhi::TextureDesc& desc = info->desc;
    if (!has(desc.usage, rhi::TextureUsage::attachment))
        return report(what, ": the texture '", info->name, "' lacks the usage attachment");
    if (rhi::info(desc.format).depth != depth)
        return report(what, ": the texture '", info->name, "' of format ", rhi::info(desc.format).name,
                      depth ? " cannot be the depth attachment" : " cannot be a colour attachment");
    if (mip >= desc.mips || layer >= desc.layers)
        return report(what, ": level ", mip, " and layer ", layer, " of the texture '", info->name, "', which has ",
                      desc.mips, " and ", desc.layers);
    const std::uint32_t width = std::max(desc.size.width >> mip, 1u), height = std::max(desc.size.height >> mip, 1u);
    if (size.width > width || size.height > height)
        return report(what, ": the render area is ", size.width, "x", size.height, ", the attachment '", info->name,
                      "' only ", width, "x", height);
    inner = info->inner;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::attached_once() {
    for (std::size_t i = 0; i < render_.colors.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (render_.colors[i].texture == render_.colors[j].texture &&
                render_.colors[i].mip == render_.colors[j].mip && render_.colors[i].layer == render_.colors[j].layer)
                return objects_->report(where("begin_render"), ": the texture '",
                                        objects_->textures.find(render_.colors[i].texture)->name,
                                        "' is attached as colours ", j, " and ", i);
    return true;
}

PELLUCID_INLINE bool RecordingChecks::attached(rhi::Texture texture, bool& read_only) const {
    read_only = false;
    if (pass_ != Pass::render) return false;
    for (const auto& color : render_.colors)
        if (color.texture == texture) return true;
    read_only = render_.depth.read_only;
    return render_.depth.texture == texture;
}

PELLUCID_INLINE bool RecordingChecks::upload_uniforms(std::size_t bytes) {
    if (!recording_) return objects_->report("upload_uniforms: no frame was begun");
    if (bytes == 0) return objects_->report(where("upload_uniforms"), ": 0 bytes");
    return true;
}

PELLUCID_INLINE bool RecordingChecks::upload_records(std::uint32_t count, std::uint32_t stride) {
    if (!recording_) return objects_->report("upload_records: no frame was begun");
    if (count != 0 && std::has_single_bit(stride) && stride <= 256) return true;
    return objects_->report(where("upload_records"), ": ", count, " records of ", stride,
                            " bytes; it takes at least one, and strides that are powers of two up to 256");
}

PELLUCID_INLINE QueriesInfo* RecordingChecks::query(rhi::Queries queries, std::uint32_t index, rhi::QueryKind kind,
                                                    const std::string& what) {
    QueriesInfo* info = objects_->find(queries, what);
    if (!info) return nullptr;
    if (info->kind != kind) {
        objects_->report(what, ": the pool '", info->name, "' is of the other kind of query");
        return nullptr;
    }
    if (index >= info->count) {
        objects_->report(what, ": query ", index, " of the pool '", info->name, "', which has ", info->count);
        return nullptr;
    }
    return info;
}

PELLUCID_INLINE bool RecordingChecks::reset(rhi::Queries queries) {
    if (!recording_) return objects_->report("reset: no frame was begun");
    if (pass_ != Pass::none) return !refused_ && objects_->report(where("reset"), ": it belongs outside passes");
    return objects_->find(queries, "reset") != nullptr;
}

PELLUCID_INLINE bool RecordingChecks::write_timestamp(rhi::Queries queries, std::uint32_t index) {
    if (!recording_) return objects_->report("write_timestamp: no frame was begun");
    if (pass_ != Pass::none && refused_) return false;
    return query(queries, index, rhi::QueryKind::timestamp, where("write_timestamp")) != nullptr;
}

PELLUCID_INLINE bool RecordingChecks::begin_query(rhi::Queries queries, std::uint32_t index) {
    if (!inside(Pass::render, "begin_query")) return false;
    const std::string what = where("begin_query");
    if (!query(queries, index, rhi::QueryKind::occlusion, what)) return false;
    if (open_query_.queries) return objects_->report(what, ": query ", open_query_.index, " is still open");
    open_query_ = {queries, index};
    return true;
}

PELLUCID_INLINE bool RecordingChecks::abandoned_query(rhi::Queries& queries, std::uint32_t& index) {
    if (pass_ != Pass::render || !open_query_.queries) return false;
    objects_->report(where("end_render"), ": query ", open_query_.index, " has not ended");
    const OpenQuery open = std::exchange(open_query_, {});
    const QueriesInfo* info = objects_->queries.find(open.queries);
    if (!info) return false;
    queries = info->inner;
    index = open.index;
    return true;
}

PELLUCID_INLINE bool RecordingChecks::end_query(rhi::Queries queries, std::uint32_t index) {
    if (!inside(Pass::render, "end_query")) return false;
    if (open_query_.queries != queries || open_query_.index != index)
        return objects_->report(where("end_query"), ": query ", index, " was not begun");
    open_query_ = {};
    return true;
}

}  // namespace pellucid::inline v0_1::validated
