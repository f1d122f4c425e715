// SPDX-License-Identifier: MIT
// Passes, the barriers where they begin, and the less frequent state changes.
#include <pellucid/vulkan/commands.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

constexpr VkPipelineStageFlags2 graphics_shaders =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkAccessFlags2 any_write = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

/// What one declared access means to Vulkan.
struct Meaning {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout;  ///< of a texture; `sampled` depends on the texture
    bool write;
};
Meaning meaning(rhi::Access access, VkPipelineStageFlags2 shaders) {
    using enum rhi::Access;
    constexpr VkAccessFlags2 load = VK_ACCESS_2_SHADER_STORAGE_READ_BIT, save = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    constexpr VkImageLayout none = VK_IMAGE_LAYOUT_UNDEFINED, general = VK_IMAGE_LAYOUT_GENERAL;
    switch (access) {
        case sampled:
            return {shaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, none, false};
        case uniform_read:
            return {shaders, VK_ACCESS_2_UNIFORM_READ_BIT, none, false};
        case storage_read:
            return {shaders, load, general, false};
        case storage_write:
            return {shaders, load | save, general, true};  // an atomic also reads
        case storage_read_write:
            return {shaders, load | save, general, true};
        case index_read:
            return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, none, false};
        case indirect_read:
            return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, none, false};
        case copy_read:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
        case copy_write:
            break;
    }
    return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            true};
}

VkAttachmentLoadOp to_vulkan(rhi::Load load) {
    return load == rhi::Load::load    ? VK_ATTACHMENT_LOAD_OP_LOAD
           : load == rhi::Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                      : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}
VkAttachmentStoreOp to_vulkan(rhi::Store store) {
    return store == rhi::Store::store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

}  // namespace

void Commands::start(VkCommandBuffer commands) {
    commands_ = commands;
    readback_written_ = false;
    in_pass_ = false;
    if (failed_) error_ = {};
    failed_ = false;
}

void Commands::begin_pass(const char* name, VkPipelineBindPoint point) {
    if (vk_.CmdBeginDebugUtilsLabelEXT) {
        VkDebugUtilsLabelEXT label = {VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = name;
        vk_.CmdBeginDebugUtilsLabelEXT(commands_, &label);
    }
    point_ = point;
    pipeline_ = {};
    layout_ = VK_NULL_HANDLE;
    bound_[0] = bound_[1] = {};
    pass_bound_ = scene_under_ = ~0u;
    indices_ = {};
    use_count_ = 0;
}

void Commands::end_pass() {
    if (vk_.CmdEndDebugUtilsLabelEXT) vk_.CmdEndDebugUtilsLabelEXT(commands_);
}

void Commands::declare(const Use& use) {
    for (std::size_t i = 0; i < use_count_; ++i) {
        Use& known = uses_[i];
        if (known.sync != use.sync) continue;
        known.stages |= use.stages;
        known.access |= use.access;
        known.write |= use.write;
        known.discard = known.discard && use.discard;
        // A read-only depth attachment is sampled in the layout it is attached in; all else meets in GENERAL.
        if (known.layout != use.layout) known.layout = VK_IMAGE_LAYOUT_GENERAL;
        return;
    }
    uses_[use_count_++] = use;
}

void Commands::declare(const rhi::Uses& uses, VkPipelineStageFlags2 shader_stages) {
    for (const rhi::ResourceUse& use : uses) {
        const Meaning m = meaning(use.access, shader_stages);
        if (use.buffer) {
            BufferObject& buffer = context_.buffers[use.buffer];
            readback_written_ |= m.write && buffer.kind == rhi::Memory::readback;
            declare({&buffer.sync, nullptr, m.stages, m.access, VK_IMAGE_LAYOUT_UNDEFINED, m.write, false});
        } else if (use.texture) {
            TextureObject& texture = context_.textures[use.texture];
            const VkImageLayout layout = use.access == rhi::Access::sampled ? texture.sampled_layout() : m.layout;
            declare({&texture.sync, &texture, m.stages, m.access, layout, m.write, false});
        }
    }
}

void Commands::barriers() {
    // What needs no change of layout goes into one global barrier: drivers treat finer ones alike.
    VkMemoryBarrier2 memory = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    std::array<VkImageMemoryBarrier2, max_uses> images;
    std::uint32_t image_count = 0;
    for (std::size_t i = 0; i < use_count_; ++i) {
        const Use& use = uses_[i];
        Sync& s = *use.sync;
        const bool transition = use.texture && s.layout != use.layout;
        if (!use.write && !transition) {
            const bool visible =
                (s.read_stages & use.stages) == use.stages && (s.read_access & use.access) == use.access;
            // Stages and accesses are remembered as two sets: the barrier covers all their pairs, so they stay true.
            s.read_stages |= use.stages;
            s.read_access |= use.access;
            if (visible || s.write_stages == 0) continue;
            memory.srcStageMask |= s.write_stages;
            memory.srcAccessMask |= s.write_access;
            memory.dstStageMask |= s.read_stages;
            memory.dstAccessMask |= s.read_access;
            continue;
        }
        // Earlier reads have only to be over; an earlier write must also have reached memory.
        const VkPipelineStageFlags2 before = s.write_stages | s.read_stages;
        if (transition) {
            VkImageMemoryBarrier2& image = images[image_count++];
            image = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
            image.srcStageMask = before;
            image.srcAccessMask = s.write_access;
            image.dstStageMask = use.stages;
            image.dstAccessMask = use.access;
            image.oldLayout = use.discard ? VK_IMAGE_LAYOUT_UNDEFINED : s.layout;
            image.newLayout = use.layout;
            image.srcQueueFamilyIndex = image.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            image.image = use.texture->handle;
            image.subresourceRange = {use.texture->aspects, 0, use.texture->mips, 0, use.texture->layers};
        } else if (before != 0) {
            memory.srcStageMask |= before;
            memory.srcAccessMask |= s.write_access;
            memory.dstStageMask |= use.stages;
            memory.dstAccessMask |= use.access;
        }
        // A change of layout writes, too: later barriers chain to the stages that waited for it.
        s.layout = use.layout;
        s.write_stages = use.stages;
        s.write_access = use.write ? use.access & any_write : 0;
        s.read_stages = use.write ? 0 : use.stages;
        s.read_access = use.write ? 0 : use.access;
    }
    if (image_count == 0 && memory.srcStageMask == 0) return;
    VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = memory.srcStageMask ? 1 : 0;
    dependency.pMemoryBarriers = &memory;
    dependency.imageMemoryBarrierCount = image_count;
    dependency.pImageMemoryBarriers = images.data();
    vk_.CmdPipelineBarrier2(commands_, &dependency);
}

void Commands::host_barrier() {
    if (!readback_written_) return;
    VkMemoryBarrier2 memory = {VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    memory.srcStageMask =
        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | graphics_shaders;
    memory.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    memory.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    memory.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &memory;
    vk_.CmdPipelineBarrier2(commands_, &dependency);
}

void Commands::begin_render(const rhi::RenderPassDesc& desc) {
    begin_pass(desc.name, VK_PIPELINE_BIND_POINT_GRAPHICS);
    VkRenderingAttachmentInfo colors[rhi::max_color_attachments] = {};
    std::uint32_t count = 0;
    for (const rhi::ColorAttachment& attachment : desc.colors) {
        TextureObject& texture = context_.textures[attachment.texture];
        const bool whole = texture.mips == 1 && texture.layers == 1;
        declare({&texture.sync, &texture, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                 VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                 VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true, whole && attachment.load != rhi::Load::load});
        VkRenderingAttachmentInfo& color = colors[count++];
        color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        color.imageView = texture.target(attachment.mip, attachment.layer);
        color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.loadOp = to_vulkan(attachment.load);
        color.storeOp = to_vulkan(attachment.store);
        if (rhi::info(texture.format).kind == rhi::NumericKind::uint)
            std::memcpy(color.clearValue.color.uint32, attachment.clear_uint, sizeof attachment.clear_uint);
        else
            std::memcpy(color.clearValue.color.float32, attachment.clear, sizeof attachment.clear);
    }
    VkRenderingAttachmentInfo depth = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    VkRenderingAttachmentInfo stencil = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    bool has_stencil = false;
    if (desc.depth.texture) {
        const rhi::DepthAttachment& attachment = desc.depth;
        TextureObject& texture = context_.textures[attachment.texture];
        has_stencil = texture.aspects & VK_IMAGE_ASPECT_STENCIL_BIT;
        const bool whole = texture.mips == 1 && texture.layers == 1;
        const bool write = !attachment.read_only || has_stencil;
        VkAccessFlags2 access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
        if (write) access |= VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        depth.imageView = texture.target(attachment.mip, attachment.layer);
        depth.imageLayout =
            attachment.read_only ? texture.sampled_layout() : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        depth.loadOp = to_vulkan(attachment.load);
        depth.storeOp = attachment.read_only ? VK_ATTACHMENT_STORE_OP_NONE : to_vulkan(attachment.store);
        depth.clearValue.depthStencil = {attachment.clear, attachment.clear_stencil};
        stencil = depth;
        stencil.storeOp = to_vulkan(attachment.store);
        declare({&texture.sync, &texture,
                 VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT, access,
                 depth.imageLayout, write, whole && attachment.load != rhi::Load::load});
    }
    declare(desc.uses, graphics_shaders);
    barriers();

    VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {desc.size.width, desc.size.height};
    info.layerCount = 1;
    info.colorAttachmentCount = count;
    info.pColorAttachments = colors;
    info.pDepthAttachment = desc.depth.texture ? &depth : nullptr;
    info.pStencilAttachment = has_stencil ? &stencil : nullptr;
    vk_.CmdBeginRendering(commands_, &info);
    // The negative height turns Vulkan's y-down clip space into the y-up one of both backends.
    const auto width = static_cast<float>(desc.size.width), height = static_cast<float>(desc.size.height);
    const VkViewport viewport = {0.0f, height, width, -height, 0.0f, 1.0f};
    vk_.CmdSetViewport(commands_, 0, 1, &viewport);
    vk_.CmdSetScissor(commands_, 0, 1, &info.renderArea);
}

void Commands::end_render() {
    vk_.CmdEndRendering(commands_);
    end_pass();
}

void Commands::begin_compute(const rhi::ComputePassDesc& desc) {
    begin_pass(desc.name, VK_PIPELINE_BIND_POINT_COMPUTE);
    declare(desc.uses, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    barriers();
}

void Commands::end_compute() {
    end_pass();
}

void Commands::begin_copy(const rhi::CopyPassDesc& desc) {
    begin_pass(desc.name, VK_PIPELINE_BIND_POINT_COMPUTE);
    declare(desc.uses, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    barriers();
}

void Commands::end_copy() {
    end_pass();
}

void Commands::change_layout(const PipelineObject& pipeline) {
    layout_ = pipeline.layout;
    pass_layout_ = pipeline.pass;
    scene_layout_ = pipeline.scene;
    // Group 1 stays bound only where the layout has the same shape for it.
    if (bound_[0] && pass_bound_ != pass_layout_) bound_[0] = {};
    if (!bound_[1] || scene_under_ == pass_layout_) return;
    const GroupObject& scene = context_.groups[bound_[1]];
    if (scene.set.layout != scene_layout_) {
        bound_[1] = {};
        return;
    }
    // Vulkan forgets group 2 when the layout of group 1 differs; the RHI keeps it.  Bind it again, which disturbs
    // whatever group 1 was; `change_group` rebinds both when group 1 comes.
    vk_.CmdBindDescriptorSets(commands_, point_, layout_, 2, 1, &scene.set.handle, 0, nullptr);
    scene_under_ = pass_layout_;
    if (!bound_[0]) pass_bound_ = ~0u;
}

void Commands::change_group(rhi::Group group) {
    const GroupObject& object = context_.groups[group];
    if (object.slot == rhi::GroupSlot::scene) {
        vk_.CmdBindDescriptorSets(commands_, point_, layout_, 2, 1, &object.set.handle, 0, nullptr);
        bound_[1] = group;
        scene_under_ = pass_layout_;
        if (!bound_[0]) pass_bound_ = ~0u;
        return;
    }
    VkDescriptorSet sets[2] = {object.set.handle, VK_NULL_HANDLE};
    std::uint32_t count = 1;
    if (bound_[1] && pass_bound_ != object.set.layout) sets[count++] = context_.groups[bound_[1]].set.handle;
    vk_.CmdBindDescriptorSets(commands_, point_, layout_, 1, count, sets, 0, nullptr);
    bound_[0] = group;
    pass_bound_ = object.set.layout;
}

VkDescriptorSet Commands::make_frame_set(std::uint32_t uniform_block, std::uint32_t record_block) {
    auto made = context_.frame_set_of(context_.frame(), uniform_block, record_block);
    if (made) return *made;
    keep(made.error());
    return context_.frame().sets[0][0];  // wrong data, but no undefined behaviour on the GPU
}

Error Commands::uniforms_too_large(std::size_t size) const {
    return {Errc::invalid_argument, "upload_uniforms: " + std::to_string(size) +
                                        " bytes; the frame's uniform block has " + std::to_string(uniform_slice_bytes) +
                                        ", put the rest into a storage buffer"};
}

Error Commands::bad_stride(std::uint32_t stride) const {
    return {Errc::invalid_argument,
            "upload_records: the stride is " + std::to_string(stride) + "; a power of two up to 256 is possible"};
}

void Commands::keep(const Error& error) {
    if (!failed_) error_ = error;
    failed_ = true;
}

}  // namespace pellucid::inline v0_1::vulkan
