// SPDX-License-Identifier: MIT
#include <pellucid/gpu/bindings.h>
#include <cstring>
#include <pellucid/shaders/bench_draws.hpp>
#include <pellucid/vulkan/dispatch.hpp>
#include "rhi_overhead/raw_vulkan_loop.hpp"

namespace pellucid::bench {

Result<std::uint32_t> RawVulkan::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted,
                                             VkMemoryPropertyFlags unwanted) {
    for (const VkMemoryPropertyFlags avoided : {unwanted, VkMemoryPropertyFlags{0}})
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags has = memory_.memoryTypes[i].propertyFlags;
            if ((allowed >> i & 1u) && (has & wanted) == wanted && !(has & avoided)) return i;
        }
    return Error{Errc::unsupported, "the raw Vulkan loop found no memory type with flags " + std::to_string(wanted)};
}

Result<RawBuffer> RawVulkan::make_buffer(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags wanted,
                                         VkMemoryPropertyFlags unwanted) {
    RawBuffer out{.size = size};
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
    RAW_VK(vk_.CreateBuffer(device_, &info, nullptr, &out.buffer));
    VkMemoryRequirements needs{};
    vk_.GetBufferMemoryRequirements(device_, out.buffer, &needs);
    PELLUCID_TRY(const std::uint32_t type, memory_type(needs.memoryTypeBits, wanted, unwanted));
    const VkMemoryAllocateInfo allocation{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
    RAW_VK(vk_.AllocateMemory(device_, &allocation, nullptr, &out.memory));
    RAW_VK(vk_.BindBufferMemory(device_, out.buffer, out.memory, 0));
    void* mapped = nullptr;
    RAW_VK(vk_.MapMemory(device_, out.memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    out.mapped = static_cast<std::byte*>(mapped);
    return out;
}

void RawVulkan::destroy(RawBuffer& buffer) {
    vk_.DestroyBuffer(device_, buffer.buffer, nullptr);
    vk_.FreeMemory(device_, buffer.memory, nullptr);
    buffer = {};
}

Result<void> RawVulkan::make_target() {
    const VkImageCreateInfo image{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = VK_FORMAT_R8G8B8A8_UNORM,
                                  .extent = {target_size, target_size, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = VK_SAMPLE_COUNT_1_BIT,
                                  .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    RAW_VK(vk_.CreateImage(device_, &image, nullptr, &target_));
    const VkImageMemoryRequirementsInfo2 asked{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_REQUIREMENTS_INFO_2,
                                               .image = target_};
    VkMemoryRequirements2 answer{.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
    vk_.GetImageMemoryRequirements2(device_, &asked, &answer);
    const VkMemoryRequirements& needs = answer.memoryRequirements;
    PELLUCID_TRY(const std::uint32_t type, memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0));
    const VkMemoryAllocateInfo allocation{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size, .memoryTypeIndex = type};
    RAW_VK(vk_.AllocateMemory(device_, &allocation, nullptr, &target_memory_));
    RAW_VK(vk_.BindImageMemory(device_, target_, target_memory_, 0));
    const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .image = target_,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = image.format,
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    RAW_VK(vk_.CreateImageView(device_, &view, nullptr, &target_view_));
    return {};
}

Result<void> RawVulkan::make_layouts() {
    const VkDescriptorSetLayoutBinding bindings[] = {
        {PELLUCID_BIND_FRAME, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, push_stages, nullptr},
        {PELLUCID_BIND_RECORDS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, push_stages, nullptr}};
    const VkDescriptorSetLayoutCreateInfo set{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 2, .pBindings = bindings};
    RAW_VK(vk_.CreateDescriptorSetLayout(device_, &set, nullptr, &set_layout_));
    const VkPushConstantRange push{push_stages, 0, sizeof(DrawMatrix)};
    const VkPipelineLayoutCreateInfo layout{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                            .setLayoutCount = 1,
                                            .pSetLayouts = &set_layout_,
                                            .pushConstantRangeCount = 1,
                                            .pPushConstantRanges = &push};
    RAW_VK(vk_.CreatePipelineLayout(device_, &layout, nullptr, &layout_));
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, frames_in_flight},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, frames_in_flight}};
    const VkDescriptorPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                          .maxSets = frames_in_flight,
                                          .poolSizeCount = 2,
                                          .pPoolSizes = sizes};
    RAW_VK(vk_.CreateDescriptorPool(device_, &pool, nullptr, &descriptors_));
    return {};
}

Result<VkPipeline> RawVulkan::make_pipeline(const rhi::Shader& vertex, const rhi::Shader& fragment) {
    VkPipelineShaderStageCreateInfo stages[2] = {};
    VkShaderModule modules[2] = {};
    for (int i = 0; i < 2; ++i) {
        const rhi::Shader& shader = i == 0 ? vertex : fragment;
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = shader.spirv.size_bytes(),
                                            .pCode = shader.spirv.data()};
        RAW_VK(vk_.CreateShaderModule(device_, &info, nullptr, &modules[i]));
        stages[i] = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                     .stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT,
                     .module = modules[i],
                     .pName = "main"};
    }
    const VkPipelineVertexInputStateCreateInfo input{.sType =
                                                         VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkViewport viewport{0, target_size, target_size, -float{target_size}, 0, 1};
    const VkRect2D scissor{{0, 0}, {target_size, target_size}};
    const VkPipelineViewportStateCreateInfo view{.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                 .viewportCount = 1,
                                                 .pViewports = &viewport,
                                                 .scissorCount = 1,
                                                 .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = VK_CULL_MODE_BACK_BIT,
        .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineColorBlendAttachmentState target{.colorWriteMask = 0xF};
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = 1,
                                                    .pAttachments = &target};
    const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachmentFormats = &format};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = 2,
                                            .pStages = stages,
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &view,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pColorBlendState = &blend,
                                            .layout = layout_};
    VkPipeline pipeline = VK_NULL_HANDLE;
    RAW_VK(vk_.CreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline));
    for (VkShaderModule module : modules) vk_.DestroyShaderModule(device_, module, nullptr);
    return pipeline;
}

Result<void> RawVulkan::make_frame(RawFrame& frame) {
    const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                       .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                       .queueFamilyIndex = native_.family};
    RAW_VK(vk_.CreateCommandPool(device_, &pool, nullptr, &frame.pool));
    const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    RAW_VK(vk_.CreateFence(device_, &fence, nullptr, &frame.fence));
    const VkCommandBufferAllocateInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                               .commandPool = frame.pool,
                                               .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                               .commandBufferCount = 1};
    RAW_VK(vk_.AllocateCommandBuffers(device_, &commands, &frame.commands));
    const VkDescriptorSetAllocateInfo set{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                          .descriptorPool = descriptors_,
                                          .descriptorSetCount = 1,
                                          .pSetLayouts = &set_layout_};
    RAW_VK(vk_.AllocateDescriptorSets(device_, &set, &frame.set));
    PELLUCID_TRY(frame.uniforms, make_buffer(sizeof(FrameUniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                             VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                             VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT));
    const VkDescriptorBufferInfo range{frame.uniforms.buffer, 0, VK_WHOLE_SIZE};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = frame.set,
                                     .dstBinding = PELLUCID_BIND_FRAME,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                     .pBufferInfo = &range};
    vk_.UpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    return reserve_records(frame, 4096);
}

/// Precondition: the frame's work is done.
Result<void> RawVulkan::reserve_records(RawFrame& frame, VkDeviceSize bytes) {
    if (bytes <= frame.records.size) return {};
    destroy(frame.records);
    PELLUCID_TRY(frame.records, make_buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                            VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT));
    const VkDescriptorBufferInfo range{frame.records.buffer, 0, VK_WHOLE_SIZE};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = frame.set,
                                     .dstBinding = PELLUCID_BIND_RECORDS,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                     .pBufferInfo = &range};
    vk_.UpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    return {};
}

Result<void> RawVulkan::make_objects() {
    PELLUCID_TRY(const vulkan::GlobalTable global, vulkan::load_global());
    PELLUCID_TRY(const vulkan::InstanceTable instance, vulkan::load_instance(global, native_.instance));
    instance.GetPhysicalDeviceMemoryProperties(native_.physical, &memory_);
    PELLUCID_CHECK(make_target());
    PELLUCID_TRY(readback_, make_buffer(target_size * target_size * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                                            VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
    constexpr std::uint32_t triangle[3] = {0, 1, 2};
    PELLUCID_TRY(indices_, make_buffer(sizeof triangle, VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 0));
    std::memcpy(indices_.mapped, triangle, sizeof triangle);
    PELLUCID_CHECK(make_layouts());
    PELLUCID_TRY(record_pipeline_, make_pipeline(shaders::bench_draws_record_vert, shaders::bench_draws_flat_frag));
    PELLUCID_TRY(push_pipeline_, make_pipeline(shaders::bench_draws_push_vert, shaders::bench_draws_flat_frag));
    for (RawFrame& frame : frames_) PELLUCID_CHECK(make_frame(frame));
    return {};
}

RawVulkan::~RawVulkan() {
    vk_.DeviceWaitIdle(device_);
    for (RawFrame& frame : frames_) {
        vk_.DestroyFence(device_, frame.fence, nullptr);
        vk_.DestroyCommandPool(device_, frame.pool, nullptr);
        destroy(frame.uniforms);
        destroy(frame.records);
    }
    destroy(readback_);
    destroy(indices_);
    vk_.DestroyPipeline(device_, record_pipeline_, nullptr);
    vk_.DestroyPipeline(device_, push_pipeline_, nullptr);
    vk_.DestroyPipelineLayout(device_, layout_, nullptr);
    vk_.DestroyDescriptorPool(device_, descriptors_, nullptr);
    vk_.DestroyDescriptorSetLayout(device_, set_layout_, nullptr);
    vk_.DestroyImageView(device_, target_view_, nullptr);
    vk_.DestroyImage(device_, target_, nullptr);
    vk_.FreeMemory(device_, target_memory_, nullptr);
}

}  // namespace pellucid::bench
