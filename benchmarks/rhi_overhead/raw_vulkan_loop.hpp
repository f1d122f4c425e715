// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The raw Vulkan loop's objects; only its own two source files include this.
#include <pellucid/rhi/shader.hpp>
#include <pellucid/vulkan/vulkan.hpp>
#include <string>
#include "rhi_overhead/loop.hpp"

// Returns an error that names the call from the enclosing function.
#define RAW_VK(call)                                                                                    \
    do {                                                                                                \
        if (const VkResult raw_result = (call); raw_result != VK_SUCCESS)                               \
            return Error{raw_result == VK_ERROR_DEVICE_LOST ? Errc::device_lost : Errc::internal,       \
                         "the raw Vulkan loop: " #call " returned " + std::to_string(int(raw_result))}; \
    } while (false)

namespace pellucid::bench {

struct RawBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
    VkDeviceSize size = 0;
};
/// What one frame in flight owns.
struct RawFrame {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    RawBuffer uniforms, records;
    VkFence fence = VK_NULL_HANDLE;
    bool pending = false;  ///< submitted and not yet waited for
};

class RawVulkan final : public Loop {
public:
    explicit RawVulkan(vulkan::Device& device)
        : owner_(device), native_(device.native()), vk_(*native_.table), device_(native_.device) {}
    ~RawVulkan() override;
    Result<void> make_objects();
    Result<FrameTime> frame(const Workload& workload, std::uint64_t number, Variant variant) override;
    std::span<const std::byte> picture() override { return {readback_.mapped, readback_.size}; }
    std::uint64_t api_calls() const override { return owner_.api_calls(); }

private:
    static constexpr VkShaderStageFlags push_stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

    Result<std::uint32_t> memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted,
                                      VkMemoryPropertyFlags unwanted);
    Result<RawBuffer> make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted,
                                  VkMemoryPropertyFlags unwanted);
    void destroy(RawBuffer& buffer);
    Result<void> make_target();
    Result<void> make_layouts();
    Result<VkPipeline> make_pipeline(const rhi::Shader& vertex, const rhi::Shader& fragment);
    Result<void> make_frame(RawFrame& frame);
    Result<void> reserve_records(RawFrame& frame, VkDeviceSize bytes);
    Result<void> wait(RawFrame& frame);
    void image_barrier(VkCommandBuffer c, VkPipelineStageFlags2 from, VkAccessFlags2 wrote, VkImageLayout before,
                       VkPipelineStageFlags2 to, VkAccessFlags2 reads, VkImageLayout after) const;

    vulkan::Device& owner_;
    vulkan::NativeDevice native_;
    const vulkan::DeviceTable& vk_;
    VkDevice device_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkImage target_ = VK_NULL_HANDLE;
    VkDeviceMemory target_memory_ = VK_NULL_HANDLE;
    VkImageView target_view_ = VK_NULL_HANDLE;
    RawBuffer readback_, indices_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline record_pipeline_ = VK_NULL_HANDLE, push_pipeline_ = VK_NULL_HANDLE;
    RawFrame frames_[frames_in_flight];
};

}  // namespace pellucid::bench
