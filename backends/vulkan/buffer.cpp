// SPDX-License-Identifier: MIT
#include <cstring>
#include <pellucid/vulkan/device.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

VkBufferUsageFlags to_usage(rhi::BufferUsage usage) {
    using enum rhi::BufferUsage;
    VkBufferUsageFlags flags = 0;
    if (has(usage, uniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (has(usage, rhi::BufferUsage::storage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (has(usage, index)) flags |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (has(usage, indirect)) flags |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (has(usage, copy_source)) flags |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    if (has(usage, copy_destination)) flags |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    return flags;
}

}  // namespace

Result<Allocation> Context::allocate(const MemoryRequest& request) {
    auto made = memory.allocate(request);
    if (made || made.error().code != Errc::out_of_memory || garbage.empty()) return made;
    // Memory of destroyed objects may be free by now, or as soon as the submitted work is done.
    if (auto waited = wait(submitted); !waited) return waited.error();
    collect();
    return memory.allocate(request);
}

Result<void> Context::raw_buffer(std::uint64_t size, VkBufferUsageFlags usage, rhi::Memory kind, const char* name,
                                 VkBuffer& buffer, Allocation& allocation) {
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage;
    if (const VkResult r = vk.CreateBuffer(device, &info, nullptr, &buffer)) return fail(r, "vkCreateBuffer", name);
    MemoryRequest request;
    request.use = kind;
    request.debug_name = name;
    vk.GetBufferMemoryRequirements(device, buffer, &request.requirements);
    auto made = allocate(request);
    if (!made) {
        vk.DestroyBuffer(device, buffer, nullptr);
        buffer = VK_NULL_HANDLE;
        return made.error();
    }
    if (const VkResult r = vk.BindBufferMemory(device, buffer, made->memory, made->offset)) {
        vk.DestroyBuffer(device, buffer, nullptr);
        buffer = VK_NULL_HANDLE;
        memory.free(*made);
        return fail(r, "vkBindBufferMemory", name);
    }
    allocation = *made;
    set_name(VK_OBJECT_TYPE_BUFFER, buffer, name);
    return {};
}

Result<rhi::Buffer> Device::make_buffer(const rhi::BufferDesc& desc) {
    Context& c = context_;
    if (desc.size == 0)
        return Error{Errc::invalid_argument,
                     std::string("buffer '") + desc.debug_name + "': its size is 0; give at least 1"};
    if (desc.initial.size() > desc.size)
        return Error{Errc::invalid_argument, std::string("buffer '") + desc.debug_name +
                                                 "': " + std::to_string(desc.initial.size()) +
                                                 " bytes of initial data for a size of " + std::to_string(desc.size)};
    const auto over = [&](const char* what, std::uint64_t limit) {
        return Error{Errc::unsupported, std::string("buffer '") + desc.debug_name + "': " + std::to_string(desc.size) +
                                            " bytes; a " + what + " buffer of this device has at most " +
                                            std::to_string(limit)};
    };
    if (has(desc.usage, rhi::BufferUsage::storage) && desc.size > c.limits.maxStorageBufferRange)
        return over("storage", c.limits.maxStorageBufferRange);
    if (has(desc.usage, rhi::BufferUsage::uniform) && desc.size > c.limits.maxUniformBufferRange)
        return over("uniform", c.limits.maxUniformBufferRange);

    BufferObject object;
    object.size = desc.size;
    object.kind = desc.memory;
    VkBufferUsageFlags usage = to_usage(desc.usage);
    const bool staged = !desc.initial.empty() && desc.memory == rhi::Memory::device;
    if (staged) usage |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    PELLUCID_CHECK(c.raw_buffer(desc.size, usage, desc.memory, desc.debug_name, object.handle, object.memory));
    if (staged) {
        if (auto uploaded = c.upload_buffer(object, desc.initial); !uploaded) {
            c.retire(VK_OBJECT_TYPE_BUFFER, object.handle, object.memory);
            return uploaded.error();
        }
    } else if (!desc.initial.empty()) {
        std::memcpy(object.memory.mapped, desc.initial.data(), desc.initial.size());
    }
    return c.buffers.insert(object);
}

std::span<std::byte> Device::mapped(rhi::Buffer buffer) {
    const BufferObject* object = context_.buffers.find(buffer);
    if (!object || object->kind == rhi::Memory::device) return {};
    return {object->memory.mapped, object->size};
}

void Device::destroy(rhi::Buffer buffer) {
    if (!alive(buffer)) return;
    const BufferObject object = context_.buffers.erase(buffer);
    context_.retire(VK_OBJECT_TYPE_BUFFER, object.handle, object.memory);
}

}  // namespace pellucid::inline v0_1::vulkan
