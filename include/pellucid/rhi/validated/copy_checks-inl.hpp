// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of `RecordingChecks`: copies.
#include <algorithm>
#include <pellucid/core/config.hpp>
#include <pellucid/rhi/validated/checks.hpp>

namespace pellucid::inline v0_1::validated {

PELLUCID_INLINE BufferInfo* RecordingChecks::copied(rhi::Buffer buffer, rhi::BufferUsage usage, rhi::Access access,
                                                    std::uint64_t offset, std::uint64_t bytes,
                                                    const std::string& what) {
    BufferInfo* info = objects_->find(buffer, what);
    if (!info) return nullptr;
    const bool reads = access == rhi::Access::copy_read;
    auto refuse = [&](const auto&... parts) {
        objects_->report(what, ": ", parts...);
        return nullptr;
    };
    if (!has(info->usage, usage))
        return refuse("the buffer '", info->name, "' lacks the usage ", reads ? "copy_source" : "copy_destination");
    if (!declared(buffer, access))
        return refuse("the pass does not declare ", reads ? "copy_read" : "copy_write", " of the buffer '", info->name,
                      "'");
    if (bytes == 0) return refuse("0 bytes of the buffer '", info->name, "'");
    if (offset > info->size || bytes > info->size - offset)
        return refuse(bytes, " bytes at ", offset, " of the buffer '", info->name, "', which has ", info->size);
    return info;
}

PELLUCID_INLINE TextureInfo* RecordingChecks::copied(rhi::Texture texture, rhi::TextureUsage usage, rhi::Access access,
                                                     const rhi::TextureCopy& copy, std::uint64_t& bytes,
                                                     const std::string& what) {
    TextureInfo* info = objects_->find(texture, what);
    if (!info) return nullptr;
    const bool reads = access == rhi::Access::copy_read;
    auto refuse = [&](const auto&... parts) {
        objects_->report(what, ": ", parts...);
        return nullptr;
    };
    const rhi::TextureDesc& desc = info->desc;
    if (!has(desc.usage, usage))
        return refuse("the texture '", info->name, "' lacks the usage ", reads ? "copy_source" : "copy_destination");
    if (!declared(texture, access))
        return refuse("the pass does not declare ", reads ? "copy_read" : "copy_write", " of the texture '", info->name,
                      "'");
    if (copy.mip >= desc.mips || copy.layer >= desc.layers)
        return refuse("level ", copy.mip, " and layer ", copy.layer, " of the texture '", info->name, "', which has ",
                      desc.mips, " and ", desc.layers);
    if (copy.buffer_offset % 16 != 0) return refuse("the offset ", copy.buffer_offset, " is no multiple of 16");
    bytes = std::uint64_t{std::max(desc.size.width >> copy.mip, 1u)} * std::max(desc.size.height >> copy.mip, 1u) *
            rhi::info(desc.format).bytes;
    return info;
}

PELLUCID_INLINE bool RecordingChecks::copy(rhi::Buffer from, rhi::Buffer to, const rhi::BufferCopy& copy) {
    if (!inside(Pass::copy, "copy")) return false;
    const std::string what = where("copy");
    if (!copied(from, rhi::BufferUsage::copy_source, rhi::Access::copy_read, copy.source_offset, copy.size, what) ||
        !copied(to, rhi::BufferUsage::copy_destination, rhi::Access::copy_write, copy.destination_offset, copy.size,
                what))
        return false;
    if (from == to && copy.source_offset < copy.destination_offset + copy.size &&
        copy.destination_offset < copy.source_offset + copy.size)
        return objects_->report(what, ": the ranges at ", copy.source_offset, " and ", copy.destination_offset, " of ",
                                copy.size, " bytes overlap in one buffer");
    return true;
}

PELLUCID_INLINE bool RecordingChecks::copy(rhi::Texture from, rhi::Buffer to, const rhi::TextureCopy& copy) {
    if (!inside(Pass::copy, "copy")) return false;
    const std::string what = where("copy");
    std::uint64_t bytes = 0;
    return copied(from, rhi::TextureUsage::copy_source, rhi::Access::copy_read, copy, bytes, what) &&
           copied(to, rhi::BufferUsage::copy_destination, rhi::Access::copy_write, copy.buffer_offset, bytes, what);
}

PELLUCID_INLINE bool RecordingChecks::copy(rhi::Buffer from, rhi::Texture to, const rhi::TextureCopy& copy) {
    if (!inside(Pass::copy, "copy")) return false;
    const std::string what = where("copy");
    std::uint64_t bytes = 0;
    return copied(to, rhi::TextureUsage::copy_destination, rhi::Access::copy_write, copy, bytes, what) &&
           copied(from, rhi::BufferUsage::copy_source, rhi::Access::copy_read, copy.buffer_offset, bytes, what);
}

PELLUCID_INLINE bool RecordingChecks::update(rhi::Buffer to, std::uint64_t offset, std::size_t bytes) {
    if (!inside(Pass::copy, "update")) return false;
    const std::string what = where("update");
    return copied(to, rhi::BufferUsage::copy_destination, rhi::Access::copy_write, offset, bytes, what) != nullptr;
}

PELLUCID_INLINE bool RecordingChecks::fill(rhi::Buffer to, std::uint64_t offset, std::uint64_t bytes) {
    if (!inside(Pass::copy, "fill")) return false;
    const std::string what = where("fill");
    if (offset % 4 != 0 || bytes % 4 != 0)
        return objects_->report(what, ": ", bytes, " bytes at ", offset, "; it writes whole words of 4 bytes");
    return copied(to, rhi::BufferUsage::copy_destination, rhi::Access::copy_write, offset, bytes, what) != nullptr;
}

PELLUCID_INLINE bool RecordingChecks::generate_mips(rhi::Texture texture) {
    if (!inside(Pass::copy, "generate_mips")) return false;
    const std::string what = where("generate_mips");
    std::uint64_t bytes = 0;
    const TextureInfo* info =
        copied(texture, rhi::TextureUsage::copy_destination, rhi::Access::copy_write, {}, bytes, what);
    if (!info) return false;
    if (!has(info->desc.usage, rhi::TextureUsage::copy_source))
        return objects_->report(what, ": the texture '", info->name, "' lacks the usage copy_source");
    return true;
}

}  // namespace pellucid::inline v0_1::validated
