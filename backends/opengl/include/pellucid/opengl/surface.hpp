// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A window of an OpenGL device: an EGL surface, which follows the window's size by itself.
#include <memory>
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/rhi/surface.hpp>
#include <string>

namespace pellucid::inline v0_1::opengl {

/// Models rhi::SurfaceOf; see rhi/surface.hpp for what the functions mean.  The device's context is current together
/// with the surface that was presented to last.
class Surface {
public:
    [[nodiscard]] static Result<std::unique_ptr<Surface>> create(Device& device, const rhi::SurfaceDesc& desc);
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    ~Surface();

    [[nodiscard]] Result<bool> present(rhi::Texture texture, Extent2D size);

private:
    explicit Surface(Device& device) : device_(device) {}
    [[nodiscard]] Result<void> start(const rhi::SurfaceDesc& desc);
    [[nodiscard]] Error fail(const char* what) const;

    Device& device_;
    std::string name_;
    void* surface_ = nullptr;  ///< EGLSurface
    bool vsync_ = true;
    bool paced_ = false;  ///< the swap interval is set: EGL wants the surface current for that
};

}  // namespace pellucid::inline v0_1::opengl

namespace pellucid::inline v0_1 {
static_assert(rhi::PresentingBackend<OpenGL>);
}
