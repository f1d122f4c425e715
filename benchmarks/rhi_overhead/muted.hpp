// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Puts empty functions in place of the driver's calls of the inner loops, so that what is left of the recording time
/// is the loop's own: differences of a nanosecond show that a driver would hide.
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/vulkan/vulkan.hpp>

namespace pellucid::bench {

/// While it lives, draws and push constants of one Vulkan device do nothing.
class MutedVulkan {
public:
    explicit MutedVulkan(vulkan::Device& device) : table_(*device.native().table), saved_(table_) {
        table_.CmdDraw = [](VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) {};
        table_.CmdDrawIndexed = [](VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t, std::int32_t,
                                   std::uint32_t) {};
        table_.CmdPushConstants = [](VkCommandBuffer, VkPipelineLayout, VkShaderStageFlags, std::uint32_t,
                                     std::uint32_t, const void*) {};
    }
    ~MutedVulkan() { table_ = saved_; }
    MutedVulkan(const MutedVulkan&) = delete;
    MutedVulkan& operator=(const MutedVulkan&) = delete;

private:
    vulkan::DeviceTable& table_;
    vulkan::DeviceTable saved_;
};

/// While it lives, draws and range bindings of every OpenGL context do nothing.  Precondition: each was called before,
/// so that libepoxy has looked it up.
class MutedOpenGL {
public:
    explicit MutedOpenGL(opengl::Device&)
        : draw_(epoxy_glDrawArraysInstancedBaseInstance),
          draw_indexed_(epoxy_glDrawElementsInstancedBaseVertexBaseInstance),
          bind_range_(epoxy_glBindBufferRange) {
        epoxy_glDrawArraysInstancedBaseInstance = [](GLenum, GLint, GLsizei, GLsizei, GLuint) {};
        epoxy_glDrawElementsInstancedBaseVertexBaseInstance = [](GLenum, GLsizei, GLenum, const void*, GLsizei, GLint,
                                                                 GLuint) {};
        epoxy_glBindBufferRange = [](GLenum, GLuint, GLuint, GLintptr, GLsizeiptr) {};
    }
    ~MutedOpenGL() {
        epoxy_glDrawArraysInstancedBaseInstance = draw_;
        epoxy_glDrawElementsInstancedBaseVertexBaseInstance = draw_indexed_;
        epoxy_glBindBufferRange = bind_range_;
    }
    MutedOpenGL(const MutedOpenGL&) = delete;
    MutedOpenGL& operator=(const MutedOpenGL&) = delete;

private:
    PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEPROC draw_;
    PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEPROC draw_indexed_;
    PFNGLBINDBUFFERRANGEPROC bind_range_;
};

}  // namespace pellucid::bench
