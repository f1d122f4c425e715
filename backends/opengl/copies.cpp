// SPDX-License-Identifier: MIT
// Copies and the frame's rings.
#include <algorithm>
#include <bit>

#include "formats.hpp"
#include "pellucid/opengl/commands.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

/// Level `mip` of a texture: width and height.
Extent2D level_size(const TextureObject& texture, std::uint32_t mip) {
    return {std::max(texture.size.width >> mip, 1u), std::max(texture.size.height >> mip, 1u)};
}

}  // namespace

void Commands::copy(rhi::Buffer source, rhi::Buffer destination, rhi::BufferCopy region) {
    glCopyNamedBufferSubData(objects_->buffers[source].name, objects_->buffers[destination].name,
                             static_cast<GLintptr>(region.source_offset),
                             static_cast<GLintptr>(region.destination_offset), static_cast<GLsizeiptr>(region.size));
}

void Commands::copy(rhi::Texture source, rhi::Buffer destination, rhi::TextureCopy region) {
    const TextureObject& texture = objects_->textures[source];
    const GlFormat format = gl_format(texture.format);
    const Extent2D size = level_size(texture, region.mip);
    const std::uint64_t bytes = std::uint64_t{size.width} * size.height * info(texture.format).bytes;
    bind_target(GL_PIXEL_PACK_BUFFER, pack_, destination);
    glGetTextureSubImage(texture.name, static_cast<GLint>(region.mip), 0, 0, static_cast<GLint>(region.layer),
                         static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), 1, format.transfer,
                         format.type, static_cast<GLsizei>(std::min<std::uint64_t>(bytes, 0x7FFFFFFFu)),
                         reinterpret_cast<void*>(region.buffer_offset));
}

void Commands::copy(rhi::Buffer source, rhi::Texture destination, rhi::TextureCopy region) {
    const TextureObject& texture = objects_->textures[destination];
    const GlFormat format = gl_format(texture.format);
    const Extent2D size = level_size(texture, region.mip);
    const auto* offset = reinterpret_cast<const void*>(region.buffer_offset);
    bind_target(GL_PIXEL_UNPACK_BUFFER, unpack_, source);
    if (texture.kind == rhi::TextureKind::flat)
        glTextureSubImage2D(texture.name, static_cast<GLint>(region.mip), 0, 0, static_cast<GLsizei>(size.width),
                            static_cast<GLsizei>(size.height), format.transfer, format.type, offset);
    else
        glTextureSubImage3D(texture.name, static_cast<GLint>(region.mip), 0, 0, static_cast<GLint>(region.layer),
                            static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), 1, format.transfer,
                            format.type, offset);
}

void Commands::update(rhi::Buffer destination, std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto size = static_cast<std::uint32_t>(std::min<std::size_t>(bytes.size(), max_update));
        const Ring::Slice slice = staging_.take(size, 16);
        if (!slice.bytes) return fail_memory("update");
        std::memcpy(slice.bytes, bytes.data(), size);
        glCopyNamedBufferSubData(staging_.block(slice.block).buffer, objects_->buffers[destination].name, slice.offset,
                                 static_cast<GLintptr>(offset), size);
        offset += size;
        bytes = bytes.subspan(size);
    }
}

void Commands::fill(rhi::Buffer destination, std::uint64_t offset, std::uint64_t size, std::uint32_t word) {
    glClearNamedBufferSubData(objects_->buffers[destination].name, GL_R32UI, static_cast<GLintptr>(offset),
                              static_cast<GLsizeiptr>(size), GL_RED_INTEGER, GL_UNSIGNED_INT, &word);
}

void Commands::generate_mips(rhi::Texture texture) {
    glGenerateTextureMipmap(objects_->textures[texture].name);
}

Result<rhi::UniformSlice> Commands::upload_uniforms(std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes.size() > max_uniform_slice)
        return Error{Errc::invalid_argument, text("upload_uniforms got %zu bytes; it takes 1 to %u: put more data into "
                                                  "a storage buffer",
                                                  bytes.size(), max_uniform_slice)};
    context_->enter();
    // Whole 16-byte units: a uniform block's size is a multiple of 16.
    const auto size = (static_cast<std::uint32_t>(bytes.size()) + 15u) & ~15u;
    const Ring::Slice slice = uniforms_.take(size, uniform_alignment_);
    if (!slice.bytes)
        return Error{Errc::out_of_memory, text("The ring of uniforms could not grow for %zu bytes", bytes.size())};
    std::memcpy(slice.bytes, bytes.data(), bytes.size());
    return rhi::UniformSlice{.block = slice.block, .offset = slice.offset};
}

Result<rhi::RecordSlice> Commands::upload_records(std::uint32_t count, std::uint32_t stride) {
    const std::uint64_t bytes = std::uint64_t{count} * stride;
    if (!std::has_single_bit(stride) || stride > 256 || bytes > Ring::max_slice_bytes)
        return Error{Errc::invalid_argument,
                     text("upload_records got %u records of %u bytes; the stride must be a power of two up to 256 and "
                          "the whole at most %u bytes",
                          count, stride, Ring::max_slice_bytes)};
    context_->enter();
    // No records take the room of one, so that there is always a place to point at.
    const Ring::Slice slice = records_.take(static_cast<std::uint32_t>(bytes > 0 ? bytes : stride), stride);
    if (!slice.bytes)
        return Error{Errc::out_of_memory,
                     text("The ring of records could not grow for %u records of %u bytes", count, stride)};
    return rhi::RecordSlice{
        .block = slice.block, .first = slice.offset / stride, .bytes = {slice.bytes, static_cast<std::size_t>(bytes)}};
}

}  // namespace pellucid::inline v0_1::opengl
