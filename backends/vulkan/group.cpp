// SPDX-License-Identifier: MIT
// Groups are descriptor sets that are written once; layouts are shared by content, pools belong to a layout.
#include <pellucid/gpu/bindings.h>
#include <algorithm>
#include <pellucid/vulkan/device.hpp>
#include "convert.hpp"

namespace pellucid::inline v0_1::vulkan {
namespace {

constexpr VkShaderStageFlags all_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
constexpr std::uint32_t sets_per_pool = 32;

VkDescriptorType type_of(const SetLayout& layout, const rhi::BindingLayout& binding) {
    if (layout.frame && binding.kind == rhi::BindingKind::uniform_buffer)
        return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    return to_vulkan(binding.kind);
}

}  // namespace

Result<std::uint32_t> Context::set_layout(const rhi::GroupLayout& shape, bool frame, const char* name) {
    for (std::uint32_t i = 0; i < set_layouts.size(); ++i)
        if (set_layouts[i].frame == frame && set_layouts[i].shape == shape) return i;
    SetLayout layout = {shape, frame, VK_NULL_HANDLE, {}};
    VkDescriptorSetLayoutBinding bindings[rhi::max_bindings] = {};
    std::uint32_t count = 0;
    for (const rhi::BindingLayout& binding : shape.bindings)
        bindings[count++] = {binding.binding, type_of(layout, binding), 1, all_stages, nullptr};
    VkDescriptorSetLayoutCreateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = count;
    info.pBindings = bindings;
    if (const VkResult r = vk.CreateDescriptorSetLayout(device, &info, nullptr, &layout.handle))
        return fail(r, "vkCreateDescriptorSetLayout", name);
    set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout.handle, name);
    set_layouts.push_back(std::move(layout));
    return static_cast<std::uint32_t>(set_layouts.size() - 1);
}

Result<const PipelineLayout*> Context::pipeline_layout(std::uint32_t pass, std::uint32_t scene, const char* name) {
    for (const PipelineLayout& layout : pipeline_layouts)
        if (layout.pass == pass && layout.scene == scene) return &layout;
    PipelineLayout layout = {pass, scene, VK_NULL_HANDLE};
    const std::uint32_t frame = set_layouts.size() > 1 ? 1 : 0;
    const VkDescriptorSetLayout sets[] = {set_layouts[frame].handle, set_layouts[pass].handle,
                                          set_layouts[scene].handle};
    // The same range everywhere, so that all layouts are compatible for group 0 and for push data.
    const VkPushConstantRange push = {all_stages, 0, rhi::max_push_bytes};
    VkPipelineLayoutCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 3;
    info.pSetLayouts = sets;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    if (const VkResult r = vk.CreatePipelineLayout(device, &info, nullptr, &layout.handle))
        return fail(r, "vkCreatePipelineLayout", name);
    set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout.handle, name);
    pipeline_layouts.push_back(layout);
    return &pipeline_layouts.back();
}

Result<DescriptorSet> Context::allocate_set(std::uint32_t index, const char* name) {
    SetLayout& layout = set_layouts[index];
    std::uint32_t p = 0;
    while (p < layout.pools.size() && layout.pools[p].free == 0) ++p;
    if (p == layout.pools.size()) {
        VkDescriptorPoolSize sizes[rhi::max_bindings] = {};
        std::uint32_t count = 0;
        for (const rhi::BindingLayout& binding : layout.shape.bindings)
            sizes[count++] = {type_of(layout, binding), sets_per_pool};
        VkDescriptorPoolCreateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
        info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
        info.maxSets = sets_per_pool;
        info.poolSizeCount = count;
        info.pPoolSizes = sizes;
        SetLayout::Pool pool = {VK_NULL_HANDLE, sets_per_pool};
        if (const VkResult r = vk.CreateDescriptorPool(device, &info, nullptr, &pool.handle))
            return fail(r, "vkCreateDescriptorPool", name);
        layout.pools.push_back(pool);
    }
    VkDescriptorSetAllocateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = layout.pools[p].handle;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout.handle;
    DescriptorSet set = {VK_NULL_HANDLE, index, p};
    if (const VkResult r = vk.AllocateDescriptorSets(device, &info, &set.handle))
        return fail(r, "vkAllocateDescriptorSets", name);
    --layout.pools[p].free;
    set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set.handle, name);
    return set;
}

Result<VkDescriptorSet> Context::frame_set_of(Frame& in, std::uint32_t uniforms, std::uint32_t records) {
    PELLUCID_TRY(const DescriptorSet set, allocate_set(1, "frame group"));
    const VkDescriptorBufferInfo views[] = {{in.uniforms.block(uniforms).buffer, 0, uniform_slice_bytes},
                                            {in.records.block(records).buffer, 0, VK_WHOLE_SIZE}};
    VkWriteDescriptorSet writes[2] = {};
    for (std::uint32_t i = 0; i < 2; ++i) {
        const rhi::BindingLayout& binding = set_layouts[1].shape.bindings[i];
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set.handle;
        writes[i].dstBinding = binding.binding;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = type_of(set_layouts[1], binding);
        writes[i].pBufferInfo = &views[i];
    }
    vk.UpdateDescriptorSets(device, 2, writes, 0, nullptr);
    in.sets[uniforms][records] = set.handle;
    return set.handle;
}

Result<rhi::Group> Device::make_group(const rhi::GroupDesc& desc) {
    Context& c = context_;
    const auto wrong = [&](std::uint32_t binding, const char* what) {
        return Error{Errc::invalid_argument,
                     std::string("group '") + desc.debug_name + "', binding " + std::to_string(binding) + ": " + what};
    };
    if (desc.slot == rhi::GroupSlot::frame)
        return Error{Errc::invalid_argument, std::string("group '") + desc.debug_name +
                                                 "': the frame group belongs to the device; use pass or scene"};
    VkWriteDescriptorSet writes[rhi::max_bindings] = {};
    VkDescriptorBufferInfo buffers[rhi::max_bindings] = {};
    VkDescriptorImageInfo images[rhi::max_bindings] = {};
    std::uint32_t count = 0;
    for (const rhi::BindingLayout& layout : desc.layout.bindings) {
        const auto given = std::find_if(desc.bindings.begin(), desc.bindings.end(),
                                        [&](const rhi::Binding& b) { return b.binding == layout.binding; });
        if (given == desc.bindings.end()) return wrong(layout.binding, "the layout has it, but nothing is bound to it");
        VkWriteDescriptorSet& write = writes[count];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstBinding = layout.binding;
        write.descriptorCount = 1;
        write.descriptorType = to_vulkan(layout.kind);
        if (layout.kind == rhi::BindingKind::uniform_buffer || layout.kind == rhi::BindingKind::storage_buffer) {
            const BufferObject* buffer = c.buffers.find(given->buffer);
            if (!buffer) return wrong(layout.binding, "its buffer was destroyed or never given");
            buffers[count] = {buffer->handle, 0, VK_WHOLE_SIZE};
            write.pBufferInfo = &buffers[count];
        } else {
            const TextureObject* texture = c.textures.find(given->texture);
            if (!texture) return wrong(layout.binding, "its texture was destroyed or never given");
            if (layout.kind == rhi::BindingKind::sampled_texture) {
                const SamplerObject* sampler = c.samplers.find(given->sampler);
                if (!sampler) return wrong(layout.binding, "its sampler was destroyed or never given");
                if (!texture->sampled)
                    return wrong(layout.binding, "its texture was made without TextureUsage::sampled");
                images[count] = {sampler->of(*texture), texture->sampled, texture->sampled_layout()};
            } else {
                if (given->mip >= texture->storage.size())
                    return wrong(layout.binding,
                                 "its texture was made without TextureUsage::storage, or has fewer mips");
                images[count] = {VK_NULL_HANDLE, texture->storage[given->mip], VK_IMAGE_LAYOUT_GENERAL};
            }
            write.pImageInfo = &images[count];
        }
        ++count;
    }
    if (desc.bindings.size() != desc.layout.bindings.size())
        return Error{Errc::invalid_argument,
                     std::string("group '") + desc.debug_name + "': " + std::to_string(desc.bindings.size()) +
                         " bindings for a layout of " + std::to_string(desc.layout.bindings.size())};
    PELLUCID_TRY(const std::uint32_t layout, c.set_layout(desc.layout, false, desc.debug_name));
    PELLUCID_TRY(const DescriptorSet set, c.allocate_set(layout, desc.debug_name));
    for (std::uint32_t i = 0; i < count; ++i) writes[i].dstSet = set.handle;
    c.vk.UpdateDescriptorSets(c.device, count, writes, 0, nullptr);
    return c.groups.insert({set, desc.slot});
}

void Device::destroy(rhi::Group group) {
    if (!alive(group)) return;
    const DescriptorSet set = context_.groups.erase(group).set;
    context_.retire(Garbage{0, VK_OBJECT_TYPE_DESCRIPTOR_SET, 0, {}, set});
}

}  // namespace pellucid::inline v0_1::vulkan
