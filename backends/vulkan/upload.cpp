// SPDX-License-Identifier: MIT
// Initial data of buffers and textures: through two fixed pieces of staging memory, whatever its size.
#include <algorithm>
#include <cstring>
#include <pellucid/vulkan/context.hpp>
#include "convert.hpp"

namespace pellucid::inline v0_1::vulkan {

Result<Context::Staged> Context::stage(std::uint64_t minimum, std::uint64_t wanted) {
    if (lost) return lost_error();
    // 16 bytes: a multiple of every texel size, as copies to images want it.
    std::uint64_t start = (upload.used + 15) & ~std::uint64_t{15};
    if (upload.recording && start + minimum > Upload::piece_bytes) {
        PELLUCID_TRY([[maybe_unused]] const std::uint64_t ticket, submit(VK_NULL_HANDLE));
        start = 0;
    }
    Upload::Piece& piece = upload.pieces[upload.current];
    if (!upload.recording) {
        PELLUCID_CHECK(wait(piece.ticket));
        start = 0;
        // Each of the three by itself: a call that failed is made again the next time.
        if (!piece.pool) {
            VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
            pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
            pool.queueFamilyIndex = family;
            if (const VkResult r = vk.CreateCommandPool(device, &pool, nullptr, &piece.pool))
                return fail(r, "vkCreateCommandPool", "upload");
        }
        if (!piece.commands) {
            VkCommandBufferAllocateInfo info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
            info.commandPool = piece.pool;
            info.commandBufferCount = 1;
            if (const VkResult r = vk.AllocateCommandBuffers(device, &info, &piece.commands)) {
                piece.commands = VK_NULL_HANDLE;
                return fail(r, "vkAllocateCommandBuffers", "upload");
            }
            set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, piece.commands, "upload commands");
        }
        if (!piece.buffer)
            PELLUCID_CHECK(raw_buffer(Upload::piece_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, rhi::Memory::upload,
                                      "upload staging", piece.buffer, piece.memory));
        if (const VkResult r = vk.ResetCommandPool(device, piece.pool, 0))
            return fail(r, "vkResetCommandPool", "upload");
        VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        if (const VkResult r = vk.BeginCommandBuffer(piece.commands, &begin))
            return fail(r, "vkBeginCommandBuffer", "upload");
        upload.recording = true;
    }
    const std::uint64_t size = std::min(wanted, Upload::piece_bytes - start);
    upload.used = start + size;
    return Staged{piece.commands, piece.buffer, start, size, piece.memory.mapped + start};
}

Result<void> Context::upload_buffer(BufferObject& buffer, std::span<const std::byte> data) {
    std::uint64_t at = 0;
    while (at < data.size()) {
        const std::uint64_t left = data.size() - at;
        PELLUCID_TRY(const Staged staged, stage(std::min<std::uint64_t>(left, 4096), left));
        std::memcpy(staged.data, data.data() + at, staged.size);
        const VkBufferCopy region = {staged.offset, at, staged.size};
        vk.CmdCopyBuffer(staged.commands, staged.buffer, buffer.handle, 1, &region);
        at += staged.size;
    }
    buffer.sync = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    return {};
}

Result<void> Context::upload_texture(TextureObject& texture, std::span<const std::byte> data) {
    const std::uint64_t texel = rhi::info(texture.format).bytes;
    bool first = true;
    std::uint64_t at = 0;
    for (std::uint32_t mip = 0; mip < texture.mips; ++mip) {
        const VkExtent3D extent = texture.extent(mip);
        const std::uint64_t row = texel * extent.width;
        for (std::uint32_t layer = 0; layer < texture.layers; ++layer) {
            std::uint32_t y = 0;
            while (y < extent.height) {
                PELLUCID_TRY(const Staged staged, stage(row, row * (extent.height - y)));
                const auto rows = static_cast<std::uint32_t>(staged.size / row);
                std::memcpy(staged.data, data.data() + at, rows * row);
                if (first) {
                    VkImageMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
                    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
                    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
                    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
                    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
                    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
                    barrier.image = texture.handle;
                    barrier.subresourceRange = {texture.aspects, 0, texture.mips, 0, texture.layers};
                    VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
                    dependency.imageMemoryBarrierCount = 1;
                    dependency.pImageMemoryBarriers = &barrier;
                    vk.CmdPipelineBarrier2(staged.commands, &dependency);
                    first = false;
                }
                VkBufferImageCopy region = {};
                region.bufferOffset = staged.offset;
                region.imageSubresource = {readable_aspect(texture.format), mip, layer, 1};
                region.imageOffset = {0, static_cast<std::int32_t>(y), 0};
                region.imageExtent = {extent.width, rows, 1};
                vk.CmdCopyBufferToImage(staged.commands, staged.buffer, texture.handle,
                                        VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
                y += rows;
                at += rows * row;
            }
        }
    }
    texture.sync = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                    VK_ACCESS_2_TRANSFER_WRITE_BIT};
    return {};
}

void Context::destroy_upload() {
    for (Upload::Piece& piece : upload.pieces) {
        if (piece.buffer) vk.DestroyBuffer(device, piece.buffer, nullptr);
        if (piece.pool) vk.DestroyCommandPool(device, piece.pool, nullptr);
        memory.free(piece.memory);
    }
}

}  // namespace pellucid::inline v0_1::vulkan
