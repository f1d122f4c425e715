// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The Vulkan device: one queue, objects behind handles, tickets count its submissions.
#include <memory>
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/desc.hpp>
#include <pellucid/vulkan/commands.hpp>
#include <pellucid/vulkan/context.hpp>
#include <span>

namespace pellucid::inline v0_1::vulkan {

/// Vulkan's own objects behind a device, for code that calls the API itself (through `table`, which has no layer of
/// this library in it but the counting thunks).  They belong to the device.
struct NativeDevice {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    std::uint32_t family;
    DeviceTable* table;  ///< a test may replace entries to make calls fail
};
/// A texture as Vulkan knows it, for code that mixes its own Vulkan with this library's.
struct NativeTexture {
    VkImage image;
    VkImageView view;  ///< all levels and layers
};
/// A pipeline as Vulkan knows it.
struct NativePipeline {
    VkPipeline pipeline;
    VkPipelineLayout layout;
};

/// Models rhi::DeviceOf; see rhi/backend.hpp for what the functions mean.
class Device {
public:
    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const rhi::DeviceDesc& desc);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    [[nodiscard]] Result<rhi::Buffer> make_buffer(const rhi::BufferDesc& desc);
    [[nodiscard]] std::span<std::byte> mapped(rhi::Buffer buffer);
    [[nodiscard]] Result<rhi::Texture> make_texture(const rhi::TextureDesc& desc);
    [[nodiscard]] Result<rhi::Sampler> make_sampler(const rhi::SamplerDesc& desc);
    [[nodiscard]] Result<rhi::Pipeline> make_pipeline(const rhi::GraphicsPipelineDesc& desc);
    [[nodiscard]] Result<rhi::Pipeline> make_pipeline(const rhi::ComputePipelineDesc& desc);
    [[nodiscard]] Result<rhi::Group> make_group(const rhi::GroupDesc& desc);
    [[nodiscard]] Result<rhi::Queries> make_queries(const rhi::QueriesDesc& desc);
    [[nodiscard]] Result<void> results(rhi::Queries queries, std::uint32_t first, std::span<std::uint64_t> out);

    void destroy(rhi::Buffer buffer);
    void destroy(rhi::Texture texture);
    void destroy(rhi::Sampler sampler);
    void destroy(rhi::Pipeline pipeline);
    void destroy(rhi::Group group);
    void destroy(rhi::Queries queries);
    [[nodiscard]] bool alive(rhi::Buffer h) const { return context_.buffers.find(h); }
    [[nodiscard]] bool alive(rhi::Texture h) const { return context_.textures.find(h); }
    [[nodiscard]] bool alive(rhi::Sampler h) const { return context_.samplers.find(h); }
    [[nodiscard]] bool alive(rhi::Pipeline h) const { return context_.pipelines.find(h); }
    [[nodiscard]] bool alive(rhi::Group h) const { return context_.groups.find(h); }
    [[nodiscard]] bool alive(rhi::Queries h) const { return context_.queries.find(h); }

    [[nodiscard]] Result<Commands*> begin_frame();
    [[nodiscard]] Result<rhi::Ticket> submit();
    [[nodiscard]] Result<void> wait(rhi::Ticket ticket);
    [[nodiscard]] bool done(rhi::Ticket ticket);
    [[nodiscard]] const rhi::DeviceInfo& info() const { return context_.device_info; }
    [[nodiscard]] std::uint64_t api_calls() const { return context_.counter.calls(); }
    [[nodiscard]] std::uint32_t live_objects() const;

    [[nodiscard]] NativeDevice native() {
        return {context_.instance->handle, context_.physical, context_.device, context_.queue,
                context_.family,           &context_.vk};
    }
    // Preconditions of all of these: the handle is alive.
    [[nodiscard]] VkBuffer native(rhi::Buffer h) const { return context_.buffers[h].handle; }
    [[nodiscard]] NativeTexture native(rhi::Texture h) const {
        return {context_.textures[h].handle, context_.textures[h].sampled};
    }
    [[nodiscard]] NativePipeline native(rhi::Pipeline h) const {
        return {context_.pipelines[h].handle, context_.pipelines[h].layout};
    }
    [[nodiscard]] VkDescriptorSet native(rhi::Group h) const { return context_.groups[h].set.handle; }
    /// [byte] device memory in blocks, and what objects use of it.
    [[nodiscard]] std::uint64_t memory_held() const { return context_.memory.held_bytes(); }
    [[nodiscard]] std::uint64_t memory_used() const { return context_.memory.used_bytes(); }

private:
    friend class Surface;
    Device() : commands_(context_) {}
    [[nodiscard]] Result<void> init(const rhi::DeviceDesc& desc);

    Context context_;
    Commands commands_;
};

}  // namespace pellucid::inline v0_1::vulkan
