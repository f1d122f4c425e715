// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Memory that the CPU writes and the GPU reads within one frame: blocks that chain and double, used from the start
/// again when the frame is done.
#include <vulkan/vulkan_core.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <pellucid/core/result.hpp>
#include <pellucid/vulkan/memory.hpp>

namespace pellucid::inline v0_1::vulkan {

struct Context;

/// One ring of one frame in flight.  The first block has 1 MiB, each further one twice the one before or more.
class Ring {
public:
    static constexpr std::uint32_t max_blocks = 16;
    static constexpr std::uint64_t first_block_bytes = std::uint64_t{1} << 20u;

    struct Block {
        VkBuffer buffer = VK_NULL_HANDLE;
        Allocation memory;
        std::uint64_t capacity = 0;  ///< [byte] that may be handed out; padding follows
    };
    struct Slice {
        std::uint32_t block = 0;
        std::uint64_t offset = 0;  ///< [byte]
        std::byte* data = nullptr;
    };

    /// \param padding [byte] allocated behind the capacity of each block, so that a fixed range bound at the last slice
    ///                stays inside the buffer.
    /// \param limit   [byte] largest block; a larger slice is an error.
    [[nodiscard]] Result<void> init(Context& context, VkBufferUsageFlags usage, std::uint64_t padding,
                                    std::uint64_t limit, const char* debug_name);
    void destroy(Context& context);
    /// From the first block again.  The GPU must be done with what was handed out.
    void rewind() noexcept { current_ = 0, cursor_ = 0; }

    /// \param alignment [byte] a power of two.
    [[nodiscard]] Result<Slice> allocate(Context& context, std::uint64_t size, std::uint64_t alignment) {
        const std::uint64_t start = (cursor_ + alignment - 1) & ~(alignment - 1);
        const Block& block = blocks_[current_];
        if (start + size > block.capacity) return grow(context, size);
        cursor_ = start + size;
        return Slice{current_, start, block.memory.mapped + start};
    }
    [[nodiscard]] const Block& block(std::uint32_t index) const { return blocks_[index]; }
    [[nodiscard]] std::uint32_t block_count() const noexcept { return count_; }

private:
    [[nodiscard]] Result<Slice> grow(Context& context, std::uint64_t size);
    [[nodiscard]] Result<void> add(Context& context, std::uint64_t capacity);

    std::array<Block, max_blocks> blocks_ = {};
    std::uint32_t count_ = 0, current_ = 0;
    std::uint64_t cursor_ = 0, padding_ = 0, limit_ = 0;
    VkBufferUsageFlags usage_ = 0;
    const char* debug_name_ = "";
};

}  // namespace pellucid::inline v0_1::vulkan
