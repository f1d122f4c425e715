// SPDX-License-Identifier: MIT
#include "rhi_overhead/raw_vulkan.hpp"
#include <cstring>
#include "rhi_overhead/raw_vulkan_loop.hpp"
#include "support/time.hpp"

namespace pellucid::bench {
namespace {

using Table = vulkan::DeviceTable;

[[gnu::noinline]] void record_draws(const Table& vk, VkCommandBuffer c, std::byte* to,
                                    std::span<const DrawMatrix> matrices) {
    std::uint32_t record = 0;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        vk.CmdDraw(c, 3, 1, 0, record++);
    }
}
[[gnu::noinline]] void record_indexed(const Table& vk, VkCommandBuffer c, std::byte* to,
                                      std::span<const DrawMatrix> matrices) {
    std::uint32_t record = 0;
    for (const DrawMatrix& matrix : matrices) {
        std::memcpy(to, &matrix, sizeof matrix);
        to += record_stride;
        vk.CmdDrawIndexed(c, 3, 1, 0, 0, record++);
    }
}
[[gnu::noinline]] void record_pushes(const Table& vk, VkCommandBuffer c, VkPipelineLayout layout,
                                     VkShaderStageFlags stages, std::span<const DrawMatrix> matrices) {
    for (const DrawMatrix& matrix : matrices) {
        vk.CmdPushConstants(c, layout, stages, 0, sizeof matrix, &matrix);
        vk.CmdDraw(c, 3, 1, 0, 0);
    }
}

}  // namespace

Result<void> RawVulkan::wait(RawFrame& frame) {
    if (!frame.pending) return {};
    RAW_VK(vk_.WaitForFences(device_, 1, &frame.fence, VK_TRUE, UINT64_MAX));
    frame.pending = false;
    return {};
}

void RawVulkan::image_barrier(VkCommandBuffer c, VkPipelineStageFlags2 from, VkAccessFlags2 wrote, VkImageLayout before,
                              VkPipelineStageFlags2 to, VkAccessFlags2 reads, VkImageLayout after) const {
    const VkImageMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                        .srcStageMask = from,
                                        .srcAccessMask = wrote,
                                        .dstStageMask = to,
                                        .dstAccessMask = reads,
                                        .oldLayout = before,
                                        .newLayout = after,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = target_,
                                        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    const VkDependencyInfo info{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
    vk_.CmdPipelineBarrier2(c, &info);
}

Result<FrameTime> RawVulkan::frame(const Workload& workload, std::uint64_t number, Variant variant) {
    const auto matrices = workload.matrices(number);
    RawFrame& frame = frames_[number % frames_in_flight];
    if (variant != Variant::push) PELLUCID_CHECK(reserve_records(frame, matrices.size() * record_stride));

    const double start = now_ns();
    PELLUCID_CHECK(wait(frame));
    RAW_VK(vk_.ResetCommandPool(device_, frame.pool, 0));
    VkCommandBuffer c = frame.commands;
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    RAW_VK(vk_.BeginCommandBuffer(c, &begin));
    const FrameUniforms uniforms;
    std::memcpy(frame.uniforms.mapped, &uniforms, sizeof uniforms);
    image_barrier(c, VK_PIPELINE_STAGE_2_COPY_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED,
                  VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                  VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = target_view_,
                                          .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                    .renderArea = {{0, 0}, {target_size, target_size}},
                                    .layerCount = 1,
                                    .colorAttachmentCount = 1,
                                    .pColorAttachments = &color};
    vk_.CmdBeginRendering(c, &rendering);
    vk_.CmdBindPipeline(c, VK_PIPELINE_BIND_POINT_GRAPHICS,
                        variant == Variant::push ? push_pipeline_ : record_pipeline_);
    vk_.CmdBindDescriptorSets(c, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &frame.set, 0, nullptr);
    switch (variant) {
        case Variant::records:
            record_draws(vk_, c, frame.records.mapped, matrices);
            break;
        case Variant::records_indexed:
            vk_.CmdBindIndexBuffer(c, indices_.buffer, 0, VK_INDEX_TYPE_UINT32);
            record_indexed(vk_, c, frame.records.mapped, matrices);
            break;
        case Variant::push:
            record_pushes(vk_, c, layout_, push_stages, matrices);
            break;
    }
    vk_.CmdEndRendering(c);
    const double recorded = now_ns();

    image_barrier(c, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                  VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {target_size, target_size, 1}};
    vk_.CmdCopyImageToBuffer(c, target_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, readback_.buffer, 1, &region);

    const VkMemoryBarrier2 to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                   .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                   .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &to_host};
    vk_.CmdPipelineBarrier2(c, &dependency);
    RAW_VK(vk_.EndCommandBuffer(c));
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, .commandBuffer = c};
    const VkSubmitInfo2 submit{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2, .commandBufferInfoCount = 1, .pCommandBufferInfos = &commands};
    RAW_VK(vk_.ResetFences(device_, 1, &frame.fence));
    RAW_VK(vk_.QueueSubmit2(native_.queue, 1, &submit, frame.fence));
    frame.pending = true;
    PELLUCID_CHECK(wait(frame));
    const double done = now_ns();
    return FrameTime{recorded - start, done - start};
}

Result<std::unique_ptr<Loop>> make_raw_vulkan(vulkan::Device& device) {
    auto loop = std::make_unique<RawVulkan>(device);
    if (auto made = loop->make_objects(); !made) return made.error();
    return std::unique_ptr<Loop>(std::move(loop));
}

}  // namespace pellucid::bench
