// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The state that `Device` and `Commands` share: the device's functions, its objects, frames and memory.
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <pellucid/core/handle.hpp>
#include <pellucid/core/log.hpp>
#include <pellucid/rhi/desc.hpp>
#include <pellucid/vulkan/dispatch.hpp>
#include <pellucid/vulkan/instance.hpp>
#include <pellucid/vulkan/memory.hpp>
#include <pellucid/vulkan/objects.hpp>
#include <pellucid/vulkan/ring.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::vulkan {

/// [byte] what the frame's uniform block may hold: the smallest maxUniformBufferRange of Vulkan.
inline constexpr std::uint32_t uniform_slice_bytes = 16384;

/// Everything of one frame in flight.
struct Frame {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    std::uint64_t ticket = 0;  ///< of its last submission
    Ring uniforms, records, staging;
    /// Group 0 for each pair of blocks, made when first bound and kept.
    std::array<std::array<VkDescriptorSet, Ring::max_blocks>, Ring::max_blocks> sets = {};
};

/// Data on its way to new buffers and textures: two pieces of staging memory with a command buffer each, recorded now
/// and submitted before the frame, or as soon as a piece is full.
struct Upload {
    static constexpr std::uint64_t piece_bytes = std::uint64_t{8} << 20u;
    struct Piece {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkBuffer buffer = VK_NULL_HANDLE;
        Allocation memory;
        std::uint64_t ticket = 0;  ///< of its last submission
    };
    std::array<Piece, 2> pieces;
    std::uint32_t current = 0;
    std::uint64_t used = 0;  ///< [byte] of the current piece
    bool recording = false;  ///< the current piece holds commands that are not submitted
};

/// An API object that is destroyed when the GPU has done `ticket`; 0 while that ticket is not known.
struct Garbage {
    std::uint64_t ticket = 0;
    VkObjectType type = VK_OBJECT_TYPE_UNKNOWN;
    std::uint64_t handle = 0;
    Allocation memory = {};
    DescriptorSet set = {};
};

struct Context {
    LogSink log;
    rhi::DeviceInfo device_info;
    std::unique_ptr<Instance> instance;
    rhi::NativeDisplay display;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits = {};
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    std::uint32_t timestamp_bits = 0;
    DeviceTable vk;
    CallCounter counter;

    SubAllocator memory;
    SlotMap<rhi::BufferTag, BufferObject> buffers;
    SlotMap<rhi::TextureTag, TextureObject> textures;
    SlotMap<rhi::SamplerTag, SamplerObject> samplers;
    SlotMap<rhi::PipelineTag, PipelineObject> pipelines;
    SlotMap<rhi::GroupTag, GroupObject> groups;
    SlotMap<rhi::QueriesTag, QueriesObject> queries;
    std::vector<SetLayout> set_layouts;  ///< [0] empty, [1] group 0, then as they come
    std::vector<PipelineLayout> pipeline_layouts;
    VkPipelineLayout base_layout = VK_NULL_HANDLE;  ///< group 0 and push data only; compatible with all
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    std::string pipeline_cache_file;
    bool pipelines_made = false;

    std::array<Frame, 4> frames;
    std::uint32_t frame_count = 0;
    std::uint32_t frame_index = 0;
    bool recording = false;
    /// The fence of submission `v` is fences[v % fence_count].  Fences rather than one timeline semaphore, because the
    /// validation layer's checks across submissions know only fences.
    static constexpr std::uint64_t fence_count = 8;
    std::array<VkFence, fence_count> fences = {};
    std::uint64_t submitted = 0;  ///< value of the last submission
    std::uint64_t completed = 0;  ///< last value known to be reached
    bool lost = false;
    Upload upload;
    std::vector<Garbage> garbage;

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();  ///< waits for the GPU and destroys everything

    [[nodiscard]] Frame& frame() { return frames[frame_index]; }
    /// The error for a failed call; remembers the loss of the device.
    [[nodiscard]] Error fail(VkResult result, const char* what, const char* name);
    [[nodiscard]] Error lost_error() const;
    template <class H>
    void set_name(VkObjectType type, H handle, const char* name) const {
        if (vk.SetDebugUtilsObjectNameEXT) set_name(type, to_bits(handle), name);
    }
    void set_name(VkObjectType type, std::uint64_t handle, const char* name) const;
    /// Handles are pointers on 64-bit systems and numbers elsewhere.
    template <class H>
    [[nodiscard]] static std::uint64_t to_bits(H handle) {
        return std::uint64_t{std::bit_cast<std::conditional_t<sizeof(H) == 8, std::uint64_t, std::uint32_t>>(handle)};
    }

    // frames and lifetime (frame.cpp)
    [[nodiscard]] Result<void> init_frames(std::uint32_t count);
    void destroy_frames();
    [[nodiscard]] Result<void> wait(std::uint64_t ticket);
    void poll();     ///< refreshes `completed`
    void collect();  ///< destroys the garbage that is due
    template <class H>
    void retire(VkObjectType type, H handle, const Allocation& allocation = {}) {
        if (handle || allocation.memory) retire(Garbage{0, type, to_bits(handle), allocation, {}});
    }
    void retire(Garbage item);
    void destroy_now(const Garbage& item);
    /// Submits the current upload piece, if it holds anything, and the frame's commands, if given.  Those wait for
    /// `before`, a transfer's semaphore, and signal `after`, where these are not null.
    [[nodiscard]] Result<std::uint64_t> submit(VkCommandBuffer frame_commands, VkSemaphore before = VK_NULL_HANDLE,
                                               VkSemaphore after = VK_NULL_HANDLE);

    // memory (buffer.cpp, upload.cpp)
    [[nodiscard]] Result<Allocation> allocate(const MemoryRequest& request);
    /// Creates a buffer and binds memory to it.
    [[nodiscard]] Result<void> raw_buffer(std::uint64_t size, VkBufferUsageFlags usage, rhi::Memory memory,
                                          const char* name, VkBuffer& buffer, Allocation& allocation);
    struct Staged {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkBuffer buffer = VK_NULL_HANDLE;
        std::uint64_t offset = 0, size = 0;  ///< [byte]
        std::byte* data = nullptr;
    };
    /// Between `minimum` and `wanted` bytes of staging memory and the command buffer to record their copy into.
    /// `minimum` is at most Upload::piece_bytes.
    [[nodiscard]] Result<Staged> stage(std::uint64_t minimum, std::uint64_t wanted);
    [[nodiscard]] Result<void> upload_buffer(BufferObject& buffer, std::span<const std::byte> data);
    [[nodiscard]] Result<void> upload_texture(TextureObject& texture, std::span<const std::byte> data);
    void destroy_upload();

    // descriptor sets and layouts (group.cpp)
    [[nodiscard]] Result<std::uint32_t> set_layout(const rhi::GroupLayout& shape, bool frame, const char* name);
    [[nodiscard]] Result<const PipelineLayout*> pipeline_layout(std::uint32_t pass, std::uint32_t scene,
                                                                const char* name);
    [[nodiscard]] Result<DescriptorSet> allocate_set(std::uint32_t layout, const char* name);
    [[nodiscard]] Result<VkDescriptorSet> frame_set_of(Frame& in, std::uint32_t uniforms, std::uint32_t records);

    // the pipeline cache's file (cache.cpp)
    [[nodiscard]] Result<void> open_pipeline_cache();
    void save_pipeline_cache();
};

}  // namespace pellucid::inline v0_1::vulkan
