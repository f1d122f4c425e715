// SPDX-License-Identifier: MIT
// Passes and state.
#include "pellucid/opengl/commands.hpp"

#include <algorithm>

#include "text.hpp"

namespace pellucid::inline v0_1::opengl {

void Commands::set_fixed_state() {
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CCW);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glDepthRange(0.0, 1.0);
    glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT);  // with UPPER_LEFT clip control: from the top
    for (const GLenum on : {GL_FRAMEBUFFER_SRGB, GL_TEXTURE_CUBE_MAP_SEAMLESS, GL_SCISSOR_TEST, GL_PROGRAM_POINT_SIZE})
        glEnable(on);
    for (const GLenum off : {GL_DITHER, GL_MULTISAMPLE, GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX,
                             GL_RASTERIZER_DISCARD, GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_STENCIL_TEST, GL_CULL_FACE,
                             GL_BLEND, GL_COLOR_LOGIC_OP, GL_POLYGON_OFFSET_FILL})
        glDisable(off);
    for (const GLenum alignment : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT}) glPixelStorei(alignment, 1);
    now_ = {};
    glDepthMask(GL_TRUE);
    glDepthFunc(now_.depth_compare);
    glStencilMask(0xFF);
    for (const GLenum face : {GL_FRONT, GL_BACK}) {
        glStencilFuncSeparate(face, GL_ALWAYS, 0, 0xFF);
        glStencilOpSeparate(face, GL_KEEP, GL_KEEP, GL_KEEP);
    }
    for (GLuint i = 0; i < rhi::max_color_attachments; ++i) {
        glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glBlendEquationSeparatei(i, GL_FUNC_ADD, GL_FUNC_ADD);
        glBlendFuncSeparatei(i, GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
    }
    glBindVertexArray(vertex_array_);
    glVertexArrayElementBuffer(vertex_array_, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glUseProgram(0);
    for (const GLenum target :
         {GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER})
        glBindBuffer(target, 0);

    pipeline_ = {};
    program_ = framebuffer_ = indirect_ = dispatch_ = pack_ = unpack_ = 0;
    raster_ = nullptr;
    pass_group_ = scene_group_ = {};
    indices_ = {};
    frame_block_ = frame_offset_ = record_block_ = unknown;
    viewport_ = {};
    scissor_ = {};
}

void Commands::begin_frame(std::uint32_t slot) {
    for (Ring* ring : {&uniforms_, &records_, &staging_}) ring->begin_frame(slot);
    mapped_written_ = false;
}

void Commands::fail(Error error) {
    if (failed_) return;  // the first failure is the cause
    failed_ = true;
    failure_ = std::move(error);
}

void Commands::fail_memory(const char* where) {
    fail({Errc::out_of_memory,
          text("The frame's ring could not grow in %s: free memory or upload less in a frame", where)});
}

// ---------------------------------------------------------------------------------------------------- passes

void Commands::begin_pass(const char* name) {
    context_->enter();
    if (labels_) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
    hazards_.begin();
}

void Commands::end_pass() {
    if (labels_) glPopDebugGroup();
}

void Commands::need(const rhi::Uses& uses) {
    for (const rhi::ResourceUse& use : uses) {
        if (use.buffer)
            hazards_.need(objects_->buffers[use.buffer].touch, barrier_bits(use.access, false), stores(use.access));
        if (use.texture)
            hazards_.need(objects_->textures[use.texture].touch, barrier_bits(use.access, true), stores(use.access));
    }
}

void Commands::mark(const rhi::Uses& uses) {
    for (const rhi::ResourceUse& use : uses) {
        if (use.buffer) {
            BufferObject& buffer = objects_->buffers[use.buffer];
            hazards_.mark(buffer.touch, stores(use.access));
            if (buffer.map && (stores(use.access) || use.access == rhi::Access::copy_write)) mapped_written_ = true;
        }
        if (use.texture) hazards_.mark(objects_->textures[use.texture].touch, stores(use.access));
    }
}

void Commands::barrier() {
    if (const GLbitfield bits = hazards_.finish()) glMemoryBarrier(bits);
}

void Commands::begin_render(const rhi::RenderPassDesc& desc) {
    begin_pass(desc.name);
    auto attachments = [&](auto&& f) {
        for (const rhi::ColorAttachment& color : desc.colors)
            if (color.texture) f(objects_->textures[color.texture].touch);
        if (desc.depth.texture) f(objects_->textures[desc.depth.texture].touch);
    };
    need(desc.uses);
    attachments([&](const Touch& touch) { hazards_.need(touch, GL_FRAMEBUFFER_BARRIER_BIT, false); });
    barrier();
    mark(desc.uses);
    attachments([&](Touch& touch) { hazards_.mark(touch, false); });

    const GLuint framebuffer = framebuffers_.find_or_make(*objects_, desc, labels_);
    if (framebuffer == 0)
        fail({Errc::unsupported, text("The driver refuses the attachments of the pass '%s': check that their formats "
                                      "can be attached and that all have the pass's size",
                                      desc.name)});
    if (framebuffer != framebuffer_) glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_ = framebuffer);
    if (viewport_ != desc.size) {
        viewport_ = desc.size;
        glViewport(0, 0, static_cast<GLsizei>(desc.size.width), static_cast<GLsizei>(desc.size.height));
    }
    set_scissor({0, 0, desc.size.width, desc.size.height});
    discard_at_end_.clear();
    if (framebuffer != 0) {
        invalidate(desc);
        clear_attachments(desc);
    }
    pipeline_ = {};  // the clears may have opened masks
    raster_ = nullptr;
}

void Commands::clear_attachments(const rhi::RenderPassDesc& desc) {
    for (std::uint32_t i = 0; i < desc.colors.size(); ++i) {
        const rhi::ColorAttachment& color = desc.colors[i];
        if (!color.texture || color.load != rhi::Load::clear) continue;
        open_color_mask(now_, i);
        if (info(objects_->textures[color.texture].format).kind == rhi::NumericKind::uint)
            glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, static_cast<GLint>(i), color.clear_uint);
        else
            glClearNamedFramebufferfv(framebuffer_, GL_COLOR, static_cast<GLint>(i), color.clear);
    }
    if (!desc.depth.texture || desc.depth.load != rhi::Load::clear) return;
    open_depth_masks(now_);
    if (info(objects_->textures[desc.depth.texture].format).stencil)
        glClearNamedFramebufferfi(framebuffer_, GL_DEPTH_STENCIL, 0, desc.depth.clear,
                                  static_cast<GLint>(desc.depth.clear_stencil));
    else
        glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &desc.depth.clear);
}

void Commands::invalidate(const rhi::RenderPassDesc& desc) {
    SmallVector<GLenum, rhi::max_color_attachments + 1> at_begin;
    auto add = [&](rhi::Texture texture, std::uint32_t mip, GLenum point, rhi::Load load, rhi::Store store) {
        // Outside the render area texels are kept, so a part is never invalidated.
        const Extent2D full = objects_->textures[texture].size;
        if (std::max(full.width >> mip, 1u) != desc.size.width || std::max(full.height >> mip, 1u) != desc.size.height)
            return;
        if (load == rhi::Load::discard) at_begin.push_back(point);
        if (store == rhi::Store::discard) discard_at_end_.push_back(point);
    };
    for (std::size_t i = 0; i < desc.colors.size(); ++i)
        if (desc.colors[i].texture)
            add(desc.colors[i].texture, desc.colors[i].mip, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i),
                desc.colors[i].load, desc.colors[i].store);
    if (desc.depth.texture)
        add(desc.depth.texture, desc.depth.mip,
            info(objects_->textures[desc.depth.texture].format).stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                        : GL_DEPTH_ATTACHMENT,
            desc.depth.load, desc.depth.store);
    if (!at_begin.empty())
        glInvalidateNamedFramebufferData(framebuffer_, static_cast<GLsizei>(at_begin.size()), at_begin.begin());
}

void Commands::end_render() {
    if (!discard_at_end_.empty())
        glInvalidateNamedFramebufferData(framebuffer_, static_cast<GLsizei>(discard_at_end_.size()),
                                         discard_at_end_.begin());
    end_pass();
}

void Commands::begin_compute(const rhi::ComputePassDesc& desc) {
    begin_pass(desc.name);
    need(desc.uses);
    barrier();
    mark(desc.uses);
}

void Commands::end_compute() {
    end_pass();
}

void Commands::begin_copy(const rhi::CopyPassDesc& desc) {
    begin_pass(desc.name);
    need(desc.uses);
    barrier();
    mark(desc.uses);
}

void Commands::end_copy() {
    end_transfers();
    end_pass();
}

void Commands::end_transfers() {
    // A bound pack or unpack buffer would turn a later transfer's CPU pointer into an offset.
    bind_target(GL_PIXEL_PACK_BUFFER, pack_, {});
    bind_target(GL_PIXEL_UNPACK_BUFFER, unpack_, {});
}

// ---------------------------------------------------------------------------------------------------- state

void Commands::set_raster(const RasterState* raster) {
    apply(now_, *raster);
    raster_ = raster;
}

void Commands::bind_other_group(rhi::Group group) {
    const GroupObject& object = objects_->groups[group];
    for (const BindRun& run : object.runs) {
        const GLuint* names = object.names + run.at;
        switch (run.kind) {
            case rhi::BindingKind::uniform_buffer:
                glBindBuffersBase(GL_UNIFORM_BUFFER, run.first, run.count, names);
                break;
            case rhi::BindingKind::storage_buffer:
                glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, run.first, run.count, names);
                break;
            case rhi::BindingKind::sampled_texture:
                glBindTextures(run.first, run.count, names);
                glBindSamplers(run.first, run.count, object.samplers + run.at);
                break;
            case rhi::BindingKind::storage_texture:
                break;  // below: multi-bind cannot name a level
        }
    }
    for (const ImageBind& image : object.images)
        glBindImageTexture(image.unit, image.texture, image.mip, image.layered, 0, GL_READ_WRITE, image.format);
    (object.slot == rhi::GroupSlot::pass ? pass_group_ : scene_group_) = group;
}

void Commands::bind_uniforms(rhi::UniformSlice uniforms) {
    const Ring::Block& block = uniforms_.block(uniforms.block);
    frame_block_ = uniforms.block;
    frame_offset_ = uniforms.offset;
    glBindBufferRange(GL_UNIFORM_BUFFER, PELLUCID_BIND_FRAME, block.buffer, uniforms.offset,
                      std::min(max_uniform_slice, block.size - uniforms.offset));
}

void Commands::bind_records(std::uint32_t block) {
    record_block_ = block;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, PELLUCID_BIND_RECORDS, records_.block(block).buffer);
}

void Commands::bind_target(GLenum target, GLuint& bound, rhi::Buffer buffer) {
    const GLuint name = buffer ? objects_->buffers[buffer].name : 0;
    if (name != bound) glBindBuffer(target, bound = name);
}

void Commands::set_scissor(rhi::Rect rect) {
    if (rect.x == scissor_.x && rect.y == scissor_.y && rect.width == scissor_.width && rect.height == scissor_.height)
        return;
    scissor_ = rect;
    glScissor(static_cast<GLint>(rect.x), static_cast<GLint>(rect.y), static_cast<GLsizei>(rect.width),
              static_cast<GLsizei>(rect.height));
}

void Commands::set_stencil_reference(std::uint8_t reference) {
    if (reference == now_.stencil_reference) return;
    RasterState wanted = now_;
    wanted.stencil_reference = reference;
    apply(now_, wanted);
    raster_ = nullptr;  // the next pipeline brings its own reference back
}

void Commands::draw_indexed_indirect(rhi::Buffer arguments, std::uint64_t offset, std::uint32_t count) {
    bind_target(GL_DRAW_INDIRECT_BUFFER, indirect_, arguments);
    glMultiDrawElementsIndirect(topology_, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                static_cast<GLsizei>(count), 0);
}

void Commands::dispatch_indirect(rhi::Buffer arguments, std::uint64_t offset) {
    bind_target(GL_DISPATCH_INDIRECT_BUFFER, dispatch_, arguments);
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
}

// ---------------------------------------------------------------------------------------------------- forgetting

void Commands::forget(rhi::Texture texture) {
    if (framebuffers_.forget(objects_->textures[texture].name, framebuffer_)) framebuffer_ = 0;
    forget_groups();
}

void Commands::forget(rhi::Buffer buffer) {
    const GLuint name = objects_->buffers[buffer].name;
    // Deleting a bound buffer unbinds it.
    for (GLuint* bound : {&indirect_, &dispatch_, &pack_, &unpack_})
        if (*bound == name) *bound = 0;
    if (indices_ == buffer) indices_ = {};
    forget_groups();
}

}  // namespace pellucid::inline v0_1::opengl
