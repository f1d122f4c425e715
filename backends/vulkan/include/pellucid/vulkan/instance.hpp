// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A Vulkan instance, its validation messages, and the choice of a device.
#include <memory>
#include <pellucid/core/log.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/desc.hpp>
#include <pellucid/vulkan/dispatch.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::vulkan {

/// Features of a device beyond Vulkan 1.3's own, by extension structure and version.
struct Features {
    VkPhysicalDeviceFeatures2 core = {};
    VkPhysicalDeviceVulkan11Features v11 = {};
    VkPhysicalDeviceVulkan12Features v12 = {};
    VkPhysicalDeviceVulkan13Features v13 = {};
    VkPhysicalDeviceFragmentShaderInterlockFeaturesEXT interlock = {};

    Features();
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;
    /// Chains the structures behind `core`; the interlock only where the device has the extension.
    void chain(bool with_interlock);
};

/// A physical device as `list` shows it, and what its creation needs.
struct Candidate {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    rhi::DeviceInfo info;
    std::uint32_t family = 0;  ///< queue family with graphics and compute
    std::uint32_t timestamp_bits = 0;
    bool interlock = false;
    bool swapchain = false;
};

/// Owns the VkInstance and its message callback.
class Instance {
public:
    /// With `validation`: the Khronos layer with synchronisation validation, also across submissions; its messages of
    /// kind validation and performance go to `log`.  Sets VK_LAYER_ENABLES in the environment while the instance is
    /// made (the layer of 2023 knows no other way), so no other thread may read the environment meanwhile.
    /// With `windows`: surfaces of that system can be made, and devices without swapchains are not usable.
    /// \returns `no_device` without a loader of Vulkan 1.3, `unsupported` where the layer is not installed or the
    /// loader knows no such windows.
    [[nodiscard]] static Result<std::unique_ptr<Instance>> create(bool validation, LogSink log,
                                                                  rhi::WindowSystem windows = rhi::WindowSystem::none);
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    [[nodiscard]] std::vector<Candidate> candidates() const;
    /// By index or part of the name (`which`), else the best usable one: discrete, integrated, virtual, CPU.
    /// \returns `no_device` with what was found and what each lacks.
    [[nodiscard]] Result<Candidate> choose(const std::string& which) const;

    GlobalTable global;
    InstanceTable vk;
    VkInstance handle = VK_NULL_HANDLE;
    bool debug_utils = false;
    rhi::WindowSystem windows = rhi::WindowSystem::none;
    LogSink log;

private:
    Instance() = default;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// Fills `wanted` with the features this library needs and those it uses where `had` has them.
/// \returns the names of what is missing, separated by commas; empty where nothing is.
[[nodiscard]] std::string choose_features(const Features& had, Features& wanted);

}  // namespace pellucid::inline v0_1::vulkan
