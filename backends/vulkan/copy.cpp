// SPDX-License-Identifier: MIT
// What may be called inside a copy pass.
#include <algorithm>
#include <pellucid/vulkan/commands.hpp>
#include "convert.hpp"

namespace pellucid::inline v0_1::vulkan {
namespace {

VkBufferImageCopy region_of(const TextureObject& texture, const rhi::TextureCopy& region) {
    VkBufferImageCopy out = {};
    out.bufferOffset = region.buffer_offset;
    out.imageSubresource = {readable_aspect(texture.format), region.mip, region.layer, 1};
    out.imageExtent = texture.extent(region.mip);
    return out;
}

}  // namespace

void Commands::copy(rhi::Buffer source, rhi::Buffer destination, rhi::BufferCopy region) {
    const VkBufferCopy part = {region.source_offset, region.destination_offset, region.size};
    vk_.CmdCopyBuffer(commands_, context_.buffers[source].handle, context_.buffers[destination].handle, 1, &part);
}

void Commands::copy(rhi::Texture source, rhi::Buffer destination, rhi::TextureCopy region) {
    const TextureObject& texture = context_.textures[source];
    const VkBufferImageCopy part = region_of(texture, region);
    vk_.CmdCopyImageToBuffer(commands_, texture.handle, texture.sync.layout, context_.buffers[destination].handle, 1,
                             &part);
}

void Commands::copy(rhi::Buffer source, rhi::Texture destination, rhi::TextureCopy region) {
    const TextureObject& texture = context_.textures[destination];
    const VkBufferImageCopy part = region_of(texture, region);
    vk_.CmdCopyBufferToImage(commands_, context_.buffers[source].handle, texture.handle, texture.sync.layout, 1, &part);
}

void Commands::update(rhi::Buffer destination, std::uint64_t offset, std::span<const std::byte> bytes) {
    constexpr std::size_t piece = 65536;
    const VkBuffer buffer = context_.buffers[destination].handle;
    Frame& frame = context_.frame();
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        const std::size_t size = std::min(piece, bytes.size() - at);
        const auto slice = frame.staging.allocate(context_, size, 16);
        if (!slice) return keep(slice.error());
        std::memcpy(slice->data, bytes.data() + at, size);
        const VkBufferCopy part = {slice->offset, offset + at, size};
        vk_.CmdCopyBuffer(commands_, frame.staging.block(slice->block).buffer, buffer, 1, &part);
    }
}

void Commands::fill(rhi::Buffer destination, std::uint64_t offset, std::uint64_t size, std::uint32_t word) {
    vk_.CmdFillBuffer(commands_, context_.buffers[destination].handle, offset, size, word);
}

void Commands::generate_mips(rhi::Texture handle) {
    TextureObject& texture = context_.textures[handle];
    if (texture.mips == 1) return;
    VkImageMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = texture.handle;
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    const auto change = [&](VkImageLayout from, VkImageLayout to, VkAccessFlags2 access, std::uint32_t first,
                            std::uint32_t count) {
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = access;
        barrier.oldLayout = from;
        barrier.newLayout = to;
        barrier.subresourceRange = {texture.aspects, first, count, 0, texture.layers};
        vk_.CmdPipelineBarrier2(commands_, &dependency);
    };
    constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                            target = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    change(VK_IMAGE_LAYOUT_UNDEFINED, target, VK_ACCESS_2_TRANSFER_WRITE_BIT, 1, texture.mips - 1);
    change(texture.sync.layout, source, VK_ACCESS_2_TRANSFER_READ_BIT, 0, 1);
    const auto corner = [](VkExtent3D extent) {
        return VkOffset3D{static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
    };
    for (std::uint32_t mip = 1; mip < texture.mips; ++mip) {
        VkImageBlit blit = {};
        blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, texture.layers};
        blit.srcOffsets[1] = corner(texture.extent(mip - 1));
        blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, texture.layers};
        blit.dstOffsets[1] = corner(texture.extent(mip));
        vk_.CmdBlitImage(commands_, texture.handle, source, texture.handle, target, 1, &blit, VK_FILTER_LINEAR);
        change(target, source, VK_ACCESS_2_TRANSFER_READ_BIT, mip, 1);
    }
    texture.sync = {source, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
}

}  // namespace pellucid::inline v0_1::vulkan
