// SPDX-License-Identifier: MIT
#include <algorithm>
#include <pellucid/vulkan/memory.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

constexpr VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}
std::string mebibytes(VkDeviceSize bytes) {
    return bytes < (1u << 20u) ? std::to_string(bytes) + " bytes" : std::to_string(bytes >> 20u) + " MiB";
}

}  // namespace

SubAllocator::SubAllocator(const VkPhysicalDeviceMemoryProperties& properties, VkDeviceSize granularity, MemoryApi api,
                           VkDeviceSize block_bytes)
    : properties_(properties), split_(granularity > 1), api_(api), block_bytes_(block_bytes) {
    pools_.resize(std::size_t{2} * properties.memoryTypeCount);
}

std::vector<std::uint32_t> SubAllocator::candidates(std::uint32_t type_bits, rhi::Memory use) const {
    constexpr VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    // What cannot be had without asking for its feature.
    constexpr VkMemoryPropertyFlags special =
        VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
        VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;
    const bool device = use == rhi::Memory::device;
    const VkMemoryPropertyFlags required = device ? VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT} : host;
    std::vector<std::pair<int, std::uint32_t>> found;
    for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[type].propertyFlags;
        if (!(type_bits >> type & 1u) || (flags & required) != required || flags & special) continue;
        const bool cached = flags & VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        int penalty = 0;
        if (device) penalty = flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT ? 1 : 0;
        if (use == rhi::Memory::upload)
            penalty = (cached ? 1 : 0) + (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT ? 2 : 0);
        if (use == rhi::Memory::readback)
            penalty = (cached ? 0 : 2) + (flags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT ? 1 : 0);
        found.emplace_back(penalty, type);
    }
    std::sort(found.begin(), found.end());  // equal penalties keep the driver's order
    std::vector<std::uint32_t> types;
    for (const auto& [penalty, type] : found) types.push_back(type);
    return types;
}

Result<Allocation> SubAllocator::allocate(const MemoryRequest& request) {
    const VkMemoryRequirements& need = request.requirements;
    const std::vector<std::uint32_t> types = candidates(need.memoryTypeBits, request.use);
    VkResult last = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (const std::uint32_t type : types) {
        const std::uint32_t pool = 2 * type + (split_ && !request.linear ? 1u : 0u);
        Allocation out;
        const bool own = request.dedicated || need.size > block_bytes_ / 2;
        if (!own) {
            for (std::uint32_t b = 0; b < pools_[pool].blocks.size(); ++b)
                if (take(pool, b, need, out)) return out;
        }
        std::uint32_t block = 0;
        last = add_block(pool, own ? need.size : block_bytes_, request, own, block);
        // A whole block may be too much where the object alone is not.
        if (last != VK_SUCCESS && last != VK_ERROR_DEVICE_LOST && !own)
            last = add_block(pool, need.size, request, true, block);
        if (last == VK_SUCCESS && take(pool, block, need, out)) return out;
        if (last == VK_ERROR_DEVICE_LOST) break;
    }
    std::string text =
        "memory for '" + std::string(request.debug_name) + "': " + mebibytes(need.size) + " were asked for";
    if (types.empty())
        return Error{Errc::unsupported, text + ", but the device has no memory type that serves this use"};
    const std::uint32_t heap = properties_.memoryTypes[types.front()].heapIndex;
    text += "; the device refused, with " + mebibytes(used_bytes_) + " in use in " + std::to_string(block_count_) +
            " blocks of " + mebibytes(held_bytes_) + " and a heap reported as " +
            mebibytes(properties_.memoryHeaps[heap].size) + "; use smaller or fewer textures and buffers";
    return Error{last == VK_ERROR_DEVICE_LOST ? Errc::device_lost : Errc::out_of_memory, text};
}

bool SubAllocator::take(std::uint32_t pool, std::uint32_t index, const VkMemoryRequirements& need, Allocation& out) {
    Block& block = pools_[pool].blocks[index];
    if (!block.memory) return false;
    for (std::size_t i = 0; i < block.free.size(); ++i) {
        const Range range = block.free[i];
        const VkDeviceSize start = align_up(range.offset, std::max<VkDeviceSize>(need.alignment, 1));
        const VkDeviceSize end = range.offset + range.size;
        if (start > end || need.size > end - start) continue;
        const Range before{range.offset, start - range.offset}, after{start + need.size, end - start - need.size};
        if (before.size && after.size) {
            block.free[i] = before;
            block.free.insert(block.free.begin() + static_cast<std::ptrdiff_t>(i) + 1, after);
        } else if (before.size || after.size) {
            block.free[i] = before.size ? before : after;
        } else {
            block.free.erase(block.free.begin() + static_cast<std::ptrdiff_t>(i));
        }
        used_bytes_ += need.size;
        out = {block.memory, start, need.size, block.mapped ? block.mapped + start : nullptr, pool, index};
        return true;
    }
    return false;
}

VkResult SubAllocator::add_block(std::uint32_t pool, VkDeviceSize size, const MemoryRequest& request, bool own,
                                 std::uint32_t& index) {
    const std::uint32_t type = pool / 2;
    const bool visible = properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    VkMemoryAllocateInfo info = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, request.dedicated, size, type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
    if (const VkResult result = api_.allocate(api_.user, info, &memory, visible ? &mapped : nullptr)) return result;
    std::vector<Block>& blocks = pools_[pool].blocks;
    index = 0;
    while (index < blocks.size() && blocks[index].memory) ++index;
    if (index == blocks.size()) blocks.emplace_back();
    blocks[index] = {memory, size, static_cast<std::byte*>(mapped), own, {{0, size}}};
    held_bytes_ += size;
    ++block_count_;
    return VK_SUCCESS;
}

void SubAllocator::drop(Block& block) {
    api_.release(api_.user, block.memory);
    held_bytes_ -= block.size;
    --block_count_;
    block = {};
}

void SubAllocator::free(const Allocation& allocation) {
    if (!allocation.memory) return;
    std::vector<Block>& blocks = pools_[allocation.pool].blocks;
    Block& block = blocks[allocation.block];
    used_bytes_ -= allocation.size;
    const auto after = std::find_if(block.free.begin(), block.free.end(),
                                    [&](const Range& range) { return range.offset > allocation.offset; });
    auto at = block.free.insert(after, {allocation.offset, allocation.size});
    if (const auto next = at + 1; next != block.free.end() && at->offset + at->size == next->offset) {
        at->size += next->size;
        block.free.erase(next);
    }
    if (at != block.free.begin() && (at - 1)->offset + (at - 1)->size == at->offset) {
        (at - 1)->size += at->size;
        block.free.erase(at);
    }
    const auto empty = [](const Block& b) { return b.memory && b.free.size() == 1 && b.free[0].size == b.size; };
    if (!empty(block)) return;
    const auto spare = std::count_if(blocks.begin(), blocks.end(), [&](const Block& b) { return empty(b) && !b.own; });
    if (block.own || spare > 1) drop(block);
}

void SubAllocator::release_all() {
    for (Pool& pool : pools_)
        for (Block& block : pool.blocks)
            if (block.memory) drop(block);
    used_bytes_ = 0;
}

}  // namespace pellucid::inline v0_1::vulkan
