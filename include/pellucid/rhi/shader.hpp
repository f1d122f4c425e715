// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A shader as the build embeds it: `pellucid_add_shader()` compiles one GLSL file into all three forms, so a program
/// ships no shader files.
#include <cstdint>
#include <span>
#include <string_view>

namespace pellucid::inline v0_1::rhi {

/// Where a shader runs.
enum class ShaderStage : std::uint8_t { vertex, fragment, compute };

/// One entry point ("main") of one stage.  All spans point at static data.
struct Shader {
    ShaderStage stage = ShaderStage::vertex;
    std::span<const std::uint32_t> spirv = {};     ///< for Vulkan 1.3
    std::span<const std::uint32_t> gl_spirv = {};  ///< for OpenGL through GL_ARB_gl_spirv
    std::string_view gl_text = {};                 ///< for OpenGL: resolved GLSL 4.50, starts with "#version"
    const char* name = "";                         ///< "stem/file.stage", shown in errors
};

/// Value of `layout(constant_id = id)`; both APIs get it when the pipeline is made.
struct SpecConstant {
    std::uint32_t id = 0;
    std::uint32_t value = 0;  ///< bits of a uint; shaders of this library use only uint constants
    friend constexpr bool operator==(SpecConstant, SpecConstant) = default;
};

}  // namespace pellucid::inline v0_1::rhi
