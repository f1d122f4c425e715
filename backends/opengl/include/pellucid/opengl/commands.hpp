// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Recording on OpenGL: every call reaches the driver at once, so "recording" is issuing.  The calls of the inner loop
/// are inline: the API call and at most three compares.
#include <pellucid/gpu/bindings.h>
#include <cstring>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/opengl/context.hpp>
#include <pellucid/opengl/framebuffers.hpp>
#include <pellucid/opengl/hazards.hpp>
#include <pellucid/opengl/objects.hpp>
#include <pellucid/opengl/ring.hpp>
#include <pellucid/rhi/desc.hpp>
#include <string>

namespace pellucid::inline v0_1::opengl {

class Device;

/// Models rhi::CommandList.  The context keeps what is bound and set between passes and frames; this class remembers it
/// and skips what is there already.  Whoever calls OpenGL itself on the device's context calls `Device::reset_state`.
class Commands {
public:
    static constexpr std::uint32_t max_uniform_slice = 16u << 10u;  ///< [byte]
    static constexpr std::uint32_t max_update = 64u << 10u;         ///< [byte] of one step of `update`

    Commands() = default;
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void begin_render(const rhi::RenderPassDesc& desc);
    void end_render();
    void begin_compute(const rhi::ComputePassDesc& desc);
    void end_compute();
    void begin_copy(const rhi::CopyPassDesc& desc);
    void end_copy();

    void bind_pipeline(rhi::Pipeline pipeline) {
        if (pipeline == pipeline_) return;
        pipeline_ = pipeline;
        const PipelineObject& object = objects_->pipelines[pipeline];
        if (object.program != program_) glUseProgram(program_ = object.program);
        if (object.raster != raster_ && object.raster) set_raster(object.raster);
        topology_ = object.topology;
    }
    void bind_group(rhi::Group group) {
        if (group != pass_group_ && group != scene_group_) bind_other_group(group);
    }
    void bind_frame(rhi::UniformSlice uniforms, const rhi::RecordSlice& records) {
        if (uniforms.offset != frame_offset_ || uniforms.block != frame_block_) bind_uniforms(uniforms);
        if (records.block != record_block_) bind_records(records.block);
    }
    void bind_index_buffer(rhi::Buffer indices) {
        if (indices == indices_) return;
        indices_ = indices;
        glVertexArrayElementBuffer(vertex_array_, objects_->buffers[indices].name);
    }
    /// Copies the bytes into the uniform ring and binds them as the push block.
    void push(std::span<const std::byte> bytes) {
        const auto size = static_cast<std::uint32_t>(bytes.size());
        const Ring::Slice slice = uniforms_.take(size, uniform_alignment_);
        if (!slice.bytes) [[unlikely]]
            return fail_memory("push");
        std::memcpy(slice.bytes, bytes.data(), bytes.size());
        glBindBufferRange(GL_UNIFORM_BUFFER, PELLUCID_BIND_PUSH, uniforms_.block(slice.block).buffer, slice.offset,
                          size);
    }
    void set_scissor(rhi::Rect rect);
    void set_stencil_reference(std::uint8_t reference);

    void draw(const rhi::Draw& d) {
        glDrawArraysInstancedBaseInstance(topology_, static_cast<GLint>(d.first_vertex),
                                          static_cast<GLsizei>(d.vertex_count), static_cast<GLsizei>(d.instance_count),
                                          d.first_instance);
    }
    void draw_indexed(const rhi::DrawIndexed& d) {
        glDrawElementsInstancedBaseVertexBaseInstance(
            topology_, static_cast<GLsizei>(d.index_count), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(std::uintptr_t{d.first_index} * sizeof(std::uint32_t)),
            static_cast<GLsizei>(d.instance_count), d.vertex_offset, d.first_instance);
    }
    void draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t count);
    void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { glDispatchCompute(x, y, z); }
    void dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset);

    void copy(rhi::Buffer source, rhi::Buffer destination, rhi::BufferCopy region);
    void copy(rhi::Texture source, rhi::Buffer destination, rhi::TextureCopy region);
    void copy(rhi::Buffer source, rhi::Texture destination, rhi::TextureCopy region);
    void update(rhi::Buffer destination, std::uint64_t offset, std::span<const std::byte> bytes);
    void fill(rhi::Buffer destination, std::uint64_t offset, std::uint64_t size, std::uint32_t word);
    void generate_mips(rhi::Texture texture);

    /// At most `max_uniform_slice` bytes.
    [[nodiscard]] Result<rhi::UniformSlice> upload_uniforms(std::span<const std::byte> bytes);
    /// `stride`: a power of two, 4 … 256 bytes.
    [[nodiscard]] Result<rhi::RecordSlice> upload_records(std::uint32_t count, std::uint32_t stride);

    void reset(rhi::Queries queries);
    void write_timestamp(rhi::Queries queries, std::uint32_t index);
    void begin_query(rhi::Queries queries, std::uint32_t index);
    void end_query(rhi::Queries queries, std::uint32_t index);

private:
    friend class Device;
    friend class Surface;

    void set_raster(const RasterState* raster);
    void bind_other_group(rhi::Group group);
    void bind_uniforms(rhi::UniformSlice uniforms);
    void bind_records(std::uint32_t block);
    void bind_target(GLenum target, GLuint& bound, rhi::Buffer buffer);
    void begin_pass(const char* name);
    void end_pass();
    void need(const rhi::Uses& uses);
    void mark(const rhi::Uses& uses);
    void barrier();
    void clear_attachments(const rhi::RenderPassDesc& desc);
    void invalidate(const rhi::RenderPassDesc& desc);
    void fail(Error error);
    void fail_memory(const char* where);
    // By the device:
    void set_fixed_state();
    void begin_frame(std::uint32_t slot);
    void forget(rhi::Texture texture);
    void forget(rhi::Buffer buffer);
    void end_transfers();
    void forget_groups() { pass_group_ = scene_group_ = {}; }
    void forget_program() { pipeline_ = {}, program_ = 0; }

    Context* context_ = nullptr;
    Objects* objects_ = nullptr;
    bool labels_ = false;
    std::uint32_t uniform_alignment_ = 256;
    GLuint vertex_array_ = 0;

    // What the context has, so that it is not set again.  A value of all ones is never right: set at the next use.
    static constexpr std::uint32_t unknown = ~0u;
    rhi::Pipeline pipeline_ = {};
    GLuint program_ = 0;
    GLenum topology_ = GL_TRIANGLES;
    const RasterState* raster_ = nullptr;  ///< null: changed since a pipeline set it
    RasterState now_ = {};
    rhi::Group pass_group_ = {}, scene_group_ = {};
    std::uint32_t frame_block_ = unknown, frame_offset_ = unknown, record_block_ = unknown;
    rhi::Buffer indices_ = {};
    GLuint indirect_ = 0, dispatch_ = 0, pack_ = 0, unpack_ = 0;
    GLuint framebuffer_ = 0;
    Extent2D viewport_ = {};
    rhi::Rect scissor_ = {};

    // The open render pass: what its end needs.
    SmallVector<GLenum, rhi::max_color_attachments + 1> discard_at_end_ = {};

    bool mapped_written_ = false;  ///< the GPU wrote mapped memory in this frame
    bool failed_ = false;
    Error failure_ = {};  ///< told by `Device::submit`
    Hazards hazards_;
    Framebuffers framebuffers_;
    Ring uniforms_, records_, staging_;
};

}  // namespace pellucid::inline v0_1::opengl
