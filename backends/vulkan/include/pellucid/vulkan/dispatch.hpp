// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Vulkan's functions, loaded at run time from libvulkan.so.1: one list per level, from which the tables, the loading
/// and the counting thunks are generated.  Nothing links to the loader, so a program starts on a machine without one.
#include <vulkan/vulkan_core.h>
#include <cstdint>
#include <pellucid/core/result.hpp>

// clang-format off
#define PELLUCID_VULKAN_GLOBAL_FUNCTIONS(X) \
    X(CreateInstance) X(EnumerateInstanceLayerProperties) X(EnumerateInstanceExtensionProperties) \
    X(EnumerateInstanceVersion)
#define PELLUCID_VULKAN_INSTANCE_FUNCTIONS(X) \
    X(DestroyInstance) X(EnumeratePhysicalDevices) X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceProperties2) \
    X(GetPhysicalDeviceFeatures2) X(GetPhysicalDeviceMemoryProperties) X(GetPhysicalDeviceQueueFamilyProperties) \
    X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceImageFormatProperties) \
    X(EnumerateDeviceExtensionProperties) X(CreateDevice) X(GetDeviceProcAddr)
#define PELLUCID_VULKAN_INSTANCE_OPTIONAL(X) \
    X(CreateDebugUtilsMessengerEXT) X(DestroyDebugUtilsMessengerEXT) \
    X(DestroySurfaceKHR) X(GetPhysicalDeviceSurfaceSupportKHR) X(GetPhysicalDeviceSurfaceCapabilitiesKHR) \
    X(GetPhysicalDeviceSurfaceFormatsKHR) X(GetPhysicalDeviceSurfacePresentModesKHR)
#define PELLUCID_VULKAN_DEVICE_FUNCTIONS(X) \
    X(DestroyDevice) X(GetDeviceQueue) X(DeviceWaitIdle) X(QueueSubmit2) \
    X(AllocateMemory) X(FreeMemory) X(MapMemory) \
    X(CreateBuffer) X(DestroyBuffer) X(GetBufferMemoryRequirements) X(BindBufferMemory) \
    X(CreateImage) X(DestroyImage) X(GetImageMemoryRequirements2) X(BindImageMemory) \
    X(CreateImageView) X(DestroyImageView) X(CreateSampler) X(DestroySampler) \
    X(CreateShaderModule) X(DestroyShaderModule) \
    X(CreatePipelineCache) X(DestroyPipelineCache) X(GetPipelineCacheData) \
    X(CreateGraphicsPipelines) X(CreateComputePipelines) X(DestroyPipeline) \
    X(CreatePipelineLayout) X(DestroyPipelineLayout) X(CreateDescriptorSetLayout) X(DestroyDescriptorSetLayout) \
    X(CreateDescriptorPool) X(DestroyDescriptorPool) X(AllocateDescriptorSets) X(FreeDescriptorSets) \
    X(UpdateDescriptorSets) \
    X(CreateCommandPool) X(DestroyCommandPool) X(ResetCommandPool) X(AllocateCommandBuffers) \
    X(BeginCommandBuffer) X(EndCommandBuffer) \
    X(CreateFence) X(DestroyFence) X(ResetFences) X(WaitForFences) X(GetFenceStatus) \
    X(CreateSemaphore) X(DestroySemaphore) \
    X(CreateQueryPool) X(DestroyQueryPool) X(ResetQueryPool) X(GetQueryPoolResults) \
    X(CmdPipelineBarrier2) X(CmdBeginRendering) X(CmdEndRendering) \
    X(CmdBindPipeline) X(CmdBindDescriptorSets) X(CmdBindIndexBuffer) X(CmdPushConstants) \
    X(CmdSetViewport) X(CmdSetScissor) X(CmdSetStencilReference) \
    X(CmdDraw) X(CmdDrawIndexed) X(CmdDrawIndexedIndirect) X(CmdDispatch) X(CmdDispatchIndirect) \
    X(CmdCopyBuffer) X(CmdCopyBufferToImage) X(CmdCopyImageToBuffer) X(CmdBlitImage) X(CmdFillBuffer) \
    X(CmdResetQueryPool) X(CmdWriteTimestamp2) X(CmdBeginQuery) X(CmdEndQuery)
#define PELLUCID_VULKAN_DEVICE_OPTIONAL(X) \
    X(SetDebugUtilsObjectNameEXT) X(CmdBeginDebugUtilsLabelEXT) X(CmdEndDebugUtilsLabelEXT) \
    X(CreateSwapchainKHR) X(DestroySwapchainKHR) X(GetSwapchainImagesKHR) X(AcquireNextImageKHR) X(QueuePresentKHR)
// clang-format on

namespace pellucid::inline v0_1::vulkan {

#define PELLUCID_VULKAN_MEMBER(function) PFN_vk##function function = nullptr;
/// Functions that need no instance.
struct GlobalTable {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    PELLUCID_VULKAN_GLOBAL_FUNCTIONS(PELLUCID_VULKAN_MEMBER)
};
/// Functions of an instance; the optional ones (debug utils, surfaces) may be null.
struct InstanceTable {
    PELLUCID_VULKAN_INSTANCE_FUNCTIONS(PELLUCID_VULKAN_MEMBER)
    PELLUCID_VULKAN_INSTANCE_OPTIONAL(PELLUCID_VULKAN_MEMBER)
};
/// Functions of one device, straight from its driver (or from the layers in front of it); the optional ones (debug
/// utils, swapchains) may be null.  A test may replace an entry to make a call fail.
struct DeviceTable {
    PELLUCID_VULKAN_DEVICE_FUNCTIONS(PELLUCID_VULKAN_MEMBER)
    PELLUCID_VULKAN_DEVICE_OPTIONAL(PELLUCID_VULKAN_MEMBER)
};
#undef PELLUCID_VULKAN_MEMBER

/// Opens the loader (once a process; it stays open, because drivers keep threads and handlers in it).
/// \returns `no_device` where there is none, with the package that has it.
[[nodiscard]] Result<GlobalTable> load_global();
/// \returns `internal`, naming the function, where a required one is missing.
[[nodiscard]] Result<InstanceTable> load_instance(const GlobalTable& global, VkInstance instance);
[[nodiscard]] Result<DeviceTable> load_device(const GlobalTable& global, const InstanceTable& vk, VkInstance instance,
                                              VkDevice device);

/// How many devices can be counted at once: a C function pointer carries no context, so each counted device takes one
/// of a fixed number of thunk sets.
inline constexpr int max_counted_devices = 4;

/// Counts the calls through a device table, while it lives.
class CallCounter {
public:
    CallCounter() = default;
    /// Replaces every entry of `table` by a thunk that counts and calls the former entry.
    /// \returns `unsupported` where `max_counted_devices` are being counted already.
    [[nodiscard]] Result<void> install(DeviceTable& table);
    CallCounter(const CallCounter&) = delete;
    CallCounter& operator=(const CallCounter&) = delete;
    ~CallCounter();
    /// Calls since `install`; 0 where it was not called.
    [[nodiscard]] std::uint64_t calls() const noexcept;

private:
    int slot_ = -1;
};

/// "VK_ERROR_DEVICE_LOST" and so on; the number for codes this library does not meet.
[[nodiscard]] std::string result_name(VkResult result);
/// The error for a failed call: "<what> for '<name>' returned VK_…".
[[nodiscard]] Error api_error(VkResult result, const char* what, const char* name);

}  // namespace pellucid::inline v0_1::vulkan
