// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The fixed-function state of a graphics pipeline in OpenGL's words, and how the context gets from one to another.
#include <array>
#include <cstdint>
#include <pellucid/opengl/calls.hpp>
#include <pellucid/rhi/desc.hpp>

namespace pellucid::inline v0_1::opengl {

struct BlendState {
    bool enabled = false;
    GLenum color_op = GL_FUNC_ADD, alpha_op = GL_FUNC_ADD;
    GLenum src_color = GL_ONE, dst_color = GL_ZERO, src_alpha = GL_ONE, dst_alpha = GL_ZERO;
    friend bool operator==(const BlendState&, const BlendState&) = default;
};
struct StencilState {
    GLenum compare = GL_ALWAYS;
    GLenum fail = GL_KEEP, depth_fail = GL_KEEP, pass = GL_KEEP;
    friend bool operator==(const StencilState&, const StencilState&) = default;
};
/// The defaults are those of a new context.
struct RasterState {
    bool depth_test = false, depth_write = true, depth_clamp = false, stencil_test = false;
    GLenum depth_compare = GL_LESS;
    GLenum cull = GL_NONE;  ///< GL_NONE, GL_BACK or GL_FRONT
    StencilState front = {}, back = {};
    std::uint8_t stencil_read_mask = 0xFF, stencil_write_mask = 0xFF, stencil_reference = 0;
    std::array<BlendState, rhi::max_color_attachments> blend = {};
    std::array<std::uint8_t, rhi::max_color_attachments> color_mask = {15, 15, 15, 15, 15, 15, 15, 15};
    friend bool operator==(const RasterState&, const RasterState&) = default;
};

[[nodiscard]] RasterState raster_state(const rhi::GraphicsPipelineDesc& desc);
/// Issues the calls by which `now`, the context's state, becomes `wanted`.
void apply(RasterState& now, const RasterState& wanted);
/// Sets everything a clear obeys to "write all": depth and stencil masks and the mask of colour target `i`.
void open_depth_masks(RasterState& now);
void open_color_mask(RasterState& now, std::uint32_t i);

}  // namespace pellucid::inline v0_1::opengl
