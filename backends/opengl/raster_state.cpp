// SPDX-License-Identifier: MIT
#include "pellucid/opengl/raster_state.hpp"

namespace pellucid::inline v0_1::opengl {
namespace {

GLenum gl(rhi::Compare compare) {
    constexpr GLenum table[] = {GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
    return table[static_cast<std::size_t>(compare)];
}
GLenum gl(rhi::BlendFactor factor) {
    constexpr GLenum table[] = {GL_ZERO,      GL_ONE,
                                GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA,
                                GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA,
                                GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR,
                                GL_DST_COLOR};
    return table[static_cast<std::size_t>(factor)];
}
GLenum gl(rhi::BlendOp op) {
    constexpr GLenum table[] = {GL_FUNC_ADD, GL_MIN, GL_MAX, GL_FUNC_REVERSE_SUBTRACT};
    return table[static_cast<std::size_t>(op)];
}
GLenum gl(rhi::StencilFace::Op op) {
    constexpr GLenum table[] = {GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
    return table[static_cast<std::size_t>(op)];
}
StencilState gl(const rhi::StencilFace& face) {
    return {
        .compare = gl(face.compare), .fail = gl(face.fail), .depth_fail = gl(face.depth_fail), .pass = gl(face.pass)};
}

void enable(GLenum what, bool on) {
    on ? glEnable(what) : glDisable(what);
}

void apply_face(GLenum face, const StencilState& wanted, const RasterState& all) {
    glStencilFuncSeparate(face, wanted.compare, all.stencil_reference, all.stencil_read_mask);
    glStencilOpSeparate(face, wanted.fail, wanted.depth_fail, wanted.pass);
}

void apply_blend(GLuint i, BlendState& now, const BlendState& wanted) {
    if (now.enabled != wanted.enabled) wanted.enabled ? glEnablei(GL_BLEND, i) : glDisablei(GL_BLEND, i);
    now.enabled = wanted.enabled;
    if (!wanted.enabled || now == wanted) return;
    glBlendEquationSeparatei(i, wanted.color_op, wanted.alpha_op);
    glBlendFuncSeparatei(i, wanted.src_color, wanted.dst_color, wanted.src_alpha, wanted.dst_alpha);
    now = wanted;
}

void set_color_mask(RasterState& now, std::uint32_t i, std::uint8_t mask) {
    if (now.color_mask[i] == mask) return;
    now.color_mask[i] = mask;
    glColorMaski(i, mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
}

}  // namespace

RasterState raster_state(const rhi::GraphicsPipelineDesc& desc) {
    RasterState out;
    const rhi::DepthStencil& depth = desc.depth;
    out.depth_test = depth.test;
    out.depth_write = depth.test && depth.write;
    out.depth_clamp = desc.depth_clamp;
    out.depth_compare = gl(depth.compare);
    out.cull = desc.cull == rhi::Cull::none ? GL_NONE : desc.cull == rhi::Cull::back ? GL_BACK : GL_FRONT;
    out.stencil_test = depth.stencil_test;
    if (depth.stencil_test) {
        out.front = gl(depth.front);
        out.back = gl(depth.back);
        out.stencil_read_mask = depth.stencil_read_mask;
        out.stencil_write_mask = depth.stencil_write_mask;
        out.stencil_reference = depth.stencil_reference;
    }
    for (std::size_t i = 0; i < desc.colors.size(); ++i) {
        const rhi::Blend& blend = desc.colors[i].blend;
        out.color_mask[i] = desc.colors[i].write_mask & 0xF;
        if (!blend.enabled) continue;
        out.blend[i] = {.enabled = true,
                        .color_op = gl(blend.color_op),
                        .alpha_op = gl(blend.alpha_op),
                        .src_color = gl(blend.src_color),
                        .dst_color = gl(blend.dst_color),
                        .src_alpha = gl(blend.src_alpha),
                        .dst_alpha = gl(blend.dst_alpha)};
    }
    return out;
}

void apply(RasterState& now, const RasterState& wanted) {
    if (now.depth_test != wanted.depth_test) enable(GL_DEPTH_TEST, now.depth_test = wanted.depth_test);
    if (now.depth_clamp != wanted.depth_clamp) enable(GL_DEPTH_CLAMP, now.depth_clamp = wanted.depth_clamp);
    if (now.depth_write != wanted.depth_write) glDepthMask(now.depth_write = wanted.depth_write);
    if (now.depth_compare != wanted.depth_compare) glDepthFunc(now.depth_compare = wanted.depth_compare);
    if (now.cull != wanted.cull) {
        if ((now.cull == GL_NONE) != (wanted.cull == GL_NONE)) enable(GL_CULL_FACE, wanted.cull != GL_NONE);
        if (wanted.cull != GL_NONE) glCullFace(wanted.cull);
        now.cull = wanted.cull;
    }
    if (now.stencil_test != wanted.stencil_test) enable(GL_STENCIL_TEST, now.stencil_test = wanted.stencil_test);
    if (wanted.stencil_test) {
        const bool masks =
            now.stencil_reference != wanted.stencil_reference || now.stencil_read_mask != wanted.stencil_read_mask;
        now.stencil_reference = wanted.stencil_reference;
        now.stencil_read_mask = wanted.stencil_read_mask;
        if (masks || now.front != wanted.front) apply_face(GL_FRONT, now.front = wanted.front, now);
        if (masks || now.back != wanted.back) apply_face(GL_BACK, now.back = wanted.back, now);
        if (now.stencil_write_mask != wanted.stencil_write_mask)
            glStencilMask(now.stencil_write_mask = wanted.stencil_write_mask);
    }
    for (std::uint32_t i = 0; i < rhi::max_color_attachments; ++i) {
        apply_blend(i, now.blend[i], wanted.blend[i]);
        set_color_mask(now, i, wanted.color_mask[i]);
    }
}

void open_depth_masks(RasterState& now) {
    if (!now.depth_write) glDepthMask(now.depth_write = true);
    if (now.stencil_write_mask != 0xFF) glStencilMask(now.stencil_write_mask = 0xFF);
}

void open_color_mask(RasterState& now, std::uint32_t i) {
    set_color_mask(now, i, 0xF);
}

}  // namespace pellucid::inline v0_1::opengl
