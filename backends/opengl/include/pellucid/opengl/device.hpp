// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The OpenGL device: a 4.5 core context through EGL, without a window, and everything made in it.
///
/// - The context stays current on the thread that made the device.  Every call of a device makes its context current
///   where another's is, so several devices may live on one thread; a device may not be used from a second thread.
/// - In one process with Vulkan: destroy the OpenGL devices *before* the Vulkan device and instance.  NVIDIA's driver
///   (580) lets a living OpenGL context read zeros, without an error, once Vulkan is gone.
/// - Pixels whose centres lie exactly on a horizontal edge (after snapping to 1/256 pixel) belong to the primitive
/// above
///   the edge here and to the one below it on Vulkan: Mesa turns the fill rule with GL_UPPER_LEFT (seen on llvmpipe
///   22.3; other drivers not looked at).  All other coverage is the same.
/// - Some drivers finish compiling at the first draw or dispatch of a pipeline, whatever the API promises; draw once
///   with each pipeline while loading where that matters.
#include <deque>
#include <memory>
#include <pellucid/core/result.hpp>
#include <pellucid/opengl/commands.hpp>
#include <pellucid/opengl/context.hpp>
#include <pellucid/opengl/objects.hpp>
#include <pellucid/rhi/desc.hpp>
#include <span>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::opengl {

class ProgramCache;

/// An OpenGL 4.5 context without a window, and everything that is made in it; used on the thread that made it.
class Device {
public:
    /// `no_device` where none fits `desc.device` (with what was found), `unsupported` where one lacks what is asked
    /// for.
    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc);
    /// Hardware first; a device that cannot be used has a `missing`.
    [[nodiscard]] static std::vector<rhi::DeviceInfo> list();
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] Result<rhi::Buffer> make_buffer(const rhi::BufferDesc& desc);
    [[nodiscard]] std::span<std::byte> mapped(rhi::Buffer buffer);
    [[nodiscard]] Result<rhi::Texture> make_texture(const rhi::TextureDesc& desc);
    [[nodiscard]] Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc& desc);
    [[nodiscard]] Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc& desc);
    [[nodiscard]] Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc& desc);
    [[nodiscard]] Result<rhi::Group> make_group(const rhi::GroupDesc& desc);
    [[nodiscard]] Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc);

    /// The driver keeps what the GPU still uses.  A null or stale handle is ignored.
    void destroy(rhi::Buffer buffer);
    void destroy(rhi::Texture texture);
    void destroy(rhi::Sampler sampler);
    void destroy(rhi::Pipeline pipeline);
    void destroy(rhi::Group group);
    void destroy(rhi::Queries queries);

    [[nodiscard]] bool alive(rhi::Buffer buffer) const { return objects_.buffers.find(buffer) != nullptr; }
    [[nodiscard]] bool alive(rhi::Texture texture) const { return objects_.textures.find(texture) != nullptr; }
    [[nodiscard]] bool alive(rhi::Sampler sampler) const { return objects_.samplers.find(sampler) != nullptr; }
    [[nodiscard]] bool alive(rhi::Pipeline pipeline) const { return objects_.pipelines.find(pipeline) != nullptr; }
    [[nodiscard]] bool alive(rhi::Group group) const { return objects_.groups.find(group) != nullptr; }
    [[nodiscard]] bool alive(rhi::Queries queries) const { return objects_.queries.find(queries) != nullptr; }

    [[nodiscard]] Result<Commands*> begin_frame();
    [[nodiscard]] Result<rhi::Ticket> submit();
    [[nodiscard]] Result<void> wait(rhi::Ticket ticket);
    [[nodiscard]] bool done(rhi::Ticket ticket);
    /// Blocks until the values are there.
    [[nodiscard]] Result<void> results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out);

    [[nodiscard]] const rhi::DeviceInfo& info() const noexcept { return info_; }
    [[nodiscard]] std::uint64_t api_calls() const noexcept { return counting_ ? context_->calls : 0; }
    [[nodiscard]] std::uint32_t live_objects() const noexcept;

    // For code that calls OpenGL itself.
    /// Makes the device's context current on this thread.
    bool make_current() { return context_->enter(); }
    /// Sets the fixed state again and forgets what is bound: call it after OpenGL calls of your own.
    void reset_state();
    [[nodiscard]] GLuint gl_name(rhi::Buffer buffer) const { return objects_.buffers[buffer].name; }
    [[nodiscard]] GLuint gl_name(rhi::Texture texture) const { return objects_.textures[texture].name; }
    [[nodiscard]] GLuint gl_name(rhi::Sampler sampler) const { return objects_.samplers[sampler].name; }
    [[nodiscard]] GLuint gl_name(rhi::Pipeline pipeline) const { return objects_.pipelines[pipeline].program; }

private:
    friend class Surface;
    struct Fence {
        GLsync sync = nullptr;
        std::uint64_t ticket = 0;
    };

    Device();
    [[nodiscard]] Result<void> start(const rhi::DeviceDesc& desc);
    [[nodiscard]] Result<void> enter();
    [[nodiscard]] Result<void> wait_for(Fence& fence);
    [[nodiscard]] Error lost_error() const;
    [[nodiscard]] Result<GLuint> make_program(std::span<const rhi::Shader* const> shaders,
                                              std::span<const rhi::SpecConstant> constants, const char* debug_name);
    [[nodiscard]] const RasterState* share(const RasterState& state);
    void label(GLenum kind, GLuint name, const char* debug_name) const;

    std::unique_ptr<Context> context_;
    std::unique_ptr<DebugSink> debug_;  ///< a stable address for the driver
    rhi::DeviceInfo info_;
    Objects objects_;
    Commands commands_;
    std::deque<RasterState> rasters_;  ///< stable addresses; each state once
    std::unique_ptr<ProgramCache> programs_;
    LogSink log_;
    rhi::NativeDisplay display_;
    bool validation_ = false, gl_spirv_ = false, counting_ = false;

    std::uint32_t frames_in_flight_ = 2;
    std::uint32_t slot_ = 0;  ///< the open or next frame's place in the rings
    bool in_frame_ = false, lost_ = false;
    std::uint64_t submitted_ = 0, completed_ = 0;  ///< tickets
    Fence fences_[4] = {};                         ///< by slot
};

}  // namespace pellucid::inline v0_1::opengl
