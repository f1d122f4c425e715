// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Device memory in blocks: a driver allows only some thousand allocations and each costs much, so objects share blocks
/// of 64 MiB.  Pure logic over two callbacks: a test runs it without a device.
#include <vulkan/vulkan_core.h>
#include <cstddef>
#include <cstdint>
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/desc.hpp>
#include <vector>

namespace pellucid::inline v0_1::vulkan {

/// A range of one VkDeviceMemory.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;      ///< [byte]
    VkDeviceSize size = 0;        ///< [byte]
    std::byte* mapped = nullptr;  ///< where the CPU sees `offset`; null for memory it does not see
    std::uint32_t pool = 0;       ///< for `SubAllocator::free`
    std::uint32_t block = 0;      ///< for `SubAllocator::free`
};

/// How blocks come and go.  `allocate` also maps the memory and stores the address where `mapped` is not null.
struct MemoryApi {
    void* user = nullptr;
    VkResult (*allocate)(void* user, const VkMemoryAllocateInfo& info, VkDeviceMemory* memory, void** mapped) = nullptr;
    void (*release)(void* user, VkDeviceMemory memory) = nullptr;
};

struct MemoryRequest {
    VkMemoryRequirements requirements = {};
    rhi::Memory use = rhi::Memory::device;
    bool linear = true;                                        ///< buffers; false: images
    const VkMemoryDedicatedAllocateInfo* dedicated = nullptr;  ///< not null: this object gets memory of its own
    const char* debug_name = "";
};

/// First fit in blocks, one list of blocks per memory type, and per linear or optimal content where the device's
/// bufferImageGranularity is above 1.  Requests above half a block get a block of their own.  An empty block is given
/// back, except one a list.  Host-visible blocks are mapped for their whole life.
class SubAllocator {
public:
    static constexpr VkDeviceSize default_block_bytes = VkDeviceSize{64} << 20u;

    SubAllocator() = default;
    SubAllocator(const VkPhysicalDeviceMemoryProperties& properties, VkDeviceSize granularity, MemoryApi api,
                 VkDeviceSize block_bytes = default_block_bytes);
    SubAllocator(SubAllocator&&) noexcept = default;
    SubAllocator& operator=(SubAllocator&&) noexcept = default;

    /// device: DEVICE_LOCAL, rather not visible to the CPU; upload: HOST_VISIBLE and HOST_COHERENT, rather
    /// write-combined and off the device; readback: HOST_VISIBLE and HOST_COHERENT, rather HOST_CACHED (so nothing is
    /// ever flushed). \returns `out_of_memory` with what was asked for and what this allocator holds.  The size of a
    /// heap is no limit
    ///          here: some drivers report less than they give.
    [[nodiscard]] Result<Allocation> allocate(const MemoryRequest& request);
    void free(const Allocation& allocation);
    /// Gives every block back, whatever is in it.
    void release_all();

    [[nodiscard]] std::uint64_t held_bytes() const noexcept { return held_bytes_; }  ///< in blocks
    [[nodiscard]] std::uint64_t used_bytes() const noexcept { return used_bytes_; }  ///< in allocations
    [[nodiscard]] std::uint32_t block_count() const noexcept { return block_count_; }
    /// The memory types that can serve the request, best first.
    [[nodiscard]] std::vector<std::uint32_t> candidates(std::uint32_t type_bits, rhi::Memory use) const;

private:
    struct Range {
        VkDeviceSize offset, size;
    };
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;  ///< null: an unused entry
        VkDeviceSize size = 0;
        std::byte* mapped = nullptr;
        bool own = false;         ///< holds one object only
        std::vector<Range> free;  ///< sorted by offset, never adjacent
    };
    struct Pool {
        std::vector<Block> blocks;
    };
    [[nodiscard]] bool take(std::uint32_t pool, std::uint32_t block, const VkMemoryRequirements& need, Allocation& out);
    [[nodiscard]] VkResult add_block(std::uint32_t pool, VkDeviceSize size, const MemoryRequest& request, bool own,
                                     std::uint32_t& block);
    void drop(Block& block);

    VkPhysicalDeviceMemoryProperties properties_ = {};
    bool split_ = false;
    MemoryApi api_ = {};
    VkDeviceSize block_bytes_ = default_block_bytes;
    std::vector<Pool> pools_;
    std::uint64_t held_bytes_ = 0, used_bytes_ = 0;
    std::uint32_t block_count_ = 0;
};

}  // namespace pellucid::inline v0_1::vulkan
