// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Formats in OpenGL's words.
#include <pellucid/opengl/calls.hpp>
#include <pellucid/rhi/format.hpp>

namespace pellucid::inline v0_1::opengl {

struct GlFormat {
    GLenum internal = 0;
    GLenum transfer = 0;  ///< of pixel transfers: channels; the depth aspect of depth-stencil
    GLenum type = 0;      ///< of pixel transfers: one channel
};

[[nodiscard]] constexpr GlFormat gl_format(rhi::Format format) noexcept {
    constexpr GlFormat table[] = {
        {},
        {GL_R8, GL_RED, GL_UNSIGNED_BYTE},
        {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
        {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE},
        {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT},
        {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT},
        {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT},
        {GL_R16F, GL_RED, GL_HALF_FLOAT},
        {GL_RG16F, GL_RG, GL_HALF_FLOAT},
        {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
        {GL_R32F, GL_RED, GL_FLOAT},
        {GL_RG32F, GL_RG, GL_FLOAT},
        {GL_RGBA32F, GL_RGBA, GL_FLOAT},
        {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
        {GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT, GL_FLOAT},
    };
    static_assert(sizeof table / sizeof table[0] == static_cast<std::size_t>(rhi::Format::count));
    return table[static_cast<std::size_t>(format)];
}

}  // namespace pellucid::inline v0_1::opengl
