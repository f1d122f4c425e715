// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The Vulkan 1.3 backend.  Its device and OpenGL's may live in one process; on NVIDIA destroy OpenGL's first (a
/// destroyed Vulkan device leaves a living OpenGL context without function there).
#include <memory>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/vulkan/commands.hpp>
#include <pellucid/vulkan/device.hpp>
#include <vector>

namespace pellucid::inline v0_1 {
namespace vulkan {
class Surface;  // vulkan/surface.hpp
}

/// The backend for Vulkan 1.3: the type that passes, renderers and `rhi::with_backend` are instantiated with.
struct Vulkan {
    static constexpr const char* name = "vulkan";
    using Device = vulkan::Device;
    using Commands = vulkan::Commands;
    using Surface = vulkan::Surface;
    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc) {
        return Device::create(desc);
    }
    /// Every device of every driver, in the order that `DeviceDesc::device` counts; those that lack something say what.
    /// Empty where there is no Vulkan loader.
    [[nodiscard]] static std::vector<rhi::DeviceInfo> list();
};

static_assert(rhi::Backend<Vulkan>);

}  // namespace pellucid::inline v0_1
