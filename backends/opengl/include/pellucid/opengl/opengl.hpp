// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The OpenGL 4.5 backend.  Link pellucid::opengl.
#include <pellucid/opengl/device.hpp>
#include <pellucid/rhi/backend.hpp>

namespace pellucid::inline v0_1 {
namespace opengl {
class Surface;  // opengl/surface.hpp
}

/// Models rhi::Backend.
struct OpenGL {
    static constexpr const char* name = "opengl";
    using Device = opengl::Device;
    using Commands = opengl::Commands;
    using Surface = opengl::Surface;

    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc) {
        return Device::create(desc);
    }
    [[nodiscard]] static std::vector<rhi::DeviceInfo> list() { return Device::list(); }
};
static_assert(rhi::Backend<OpenGL>);

}  // namespace pellucid::inline v0_1
