// SPDX-License-Identifier: MIT
#include <algorithm>
#include <pellucid/vulkan/context.hpp>

namespace pellucid::inline v0_1::vulkan {

Result<void> Ring::init(Context& context, VkBufferUsageFlags usage, std::uint64_t padding, std::uint64_t limit,
                        const char* debug_name) {
    usage_ = usage;
    padding_ = padding;
    limit_ = limit;
    debug_name_ = debug_name;
    return add(context, first_block_bytes);
}

void Ring::destroy(Context& context) {
    for (std::uint32_t i = 0; i < count_; ++i) {
        context.vk.DestroyBuffer(context.device, blocks_[i].buffer, nullptr);
        context.memory.free(blocks_[i].memory);
    }
    count_ = 0;
}

Result<void> Ring::add(Context& context, std::uint64_t capacity) {
    Block block;
    PELLUCID_CHECK(
        context.raw_buffer(capacity + padding_, usage_, rhi::Memory::upload, debug_name_, block.buffer, block.memory));
    block.capacity = capacity;
    blocks_[count_++] = block;
    return {};
}

Result<Ring::Slice> Ring::grow(Context& context, std::uint64_t size) {
    if (size > limit_)
        return Error{Errc::invalid_argument, std::string("the ") + debug_name_ + " was asked for " +
                                                 std::to_string(size) + " bytes at once; this device binds at most " +
                                                 std::to_string(limit_)};
    // Blocks double, so one that exists already may still be too small for this slice.
    std::uint32_t next = current_ + 1;
    while (next < count_ && blocks_[next].capacity < size) ++next;
    if (next == count_) {
        if (count_ == max_blocks)
            return Error{Errc::out_of_memory, std::string("the ") + debug_name_ + " is full: a frame may take " +
                                                  std::to_string(max_blocks) + " blocks, the last of " +
                                                  std::to_string(blocks_[count_ - 1].capacity) + " bytes"};
        const std::uint64_t doubled = std::min(2 * blocks_[count_ - 1].capacity, limit_);
        PELLUCID_CHECK(add(context, std::max(doubled, size)));
    }
    current_ = next;
    cursor_ = size;
    return Slice{current_, 0, blocks_[current_].memory.mapped};
}

}  // namespace pellucid::inline v0_1::vulkan
