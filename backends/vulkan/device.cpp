// SPDX-License-Identifier: MIT
#include <pellucid/gpu/bindings.h>
#include <algorithm>
#include <pellucid/vulkan/device.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

/// Memory callbacks of the sub-allocator; `user` is the Context.
VkResult allocate_memory(void* user, const VkMemoryAllocateInfo& info, VkDeviceMemory* memory, void** mapped) {
    Context& context = *static_cast<Context*>(user);
    const VkResult result = context.vk.AllocateMemory(context.device, &info, nullptr, memory);
    if (result != VK_SUCCESS || !mapped) return result;
    const VkResult map = context.vk.MapMemory(context.device, *memory, 0, VK_WHOLE_SIZE, 0, mapped);
    if (map != VK_SUCCESS) context.vk.FreeMemory(context.device, *memory, nullptr);
    return map;
}
void free_memory(void* user, VkDeviceMemory memory) {
    Context& context = *static_cast<Context*>(user);
    context.vk.FreeMemory(context.device, memory, nullptr);
}

Result<void> make_device(Context& context, const Candidate& candidate) {
    const InstanceTable& vk = context.instance->vk;
    Features had, wanted;
    had.chain(candidate.interlock);
    vk.GetPhysicalDeviceFeatures2(candidate.handle, &had.core);
    (void)choose_features(had, wanted);  // a candidate that lacks one was refused before
    wanted.chain(candidate.interlock);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = candidate.family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    SmallVector<const char*, 2> extensions;
    if (candidate.interlock) extensions.push_back(VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME);
    if (context.instance->windows != rhi::WindowSystem::none) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &wanted.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.begin();
    VkDevice device = VK_NULL_HANDLE;
    if (const VkResult r = vk.CreateDevice(candidate.handle, &info, nullptr, &device))
        return api_error(r, "vkCreateDevice", candidate.info.name.c_str());
    auto table = load_device(context.instance->global, vk, context.instance->handle, device);
    if (!table) {
        const auto destroy =
            reinterpret_cast<PFN_vkDestroyDevice>(vk.GetDeviceProcAddr(device, "vkDestroyDevice"));  // NOLINT
        if (destroy) destroy(device, nullptr);
        return table.error();
    }
    context.device = device;
    context.vk = *table;
    if (!context.instance->debug_utils) {
        context.vk.SetDebugUtilsObjectNameEXT = nullptr;
        context.vk.CmdBeginDebugUtilsLabelEXT = nullptr;
        context.vk.CmdEndDebugUtilsLabelEXT = nullptr;
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<Device>> Device::create(const rhi::DeviceDesc& desc) {
    if (desc.frames_in_flight < 1 || desc.frames_in_flight > 4)
        return Error{Errc::invalid_argument, "DeviceDesc::frames_in_flight is " +
                                                 std::to_string(desc.frames_in_flight) + "; 1 to 4 are possible"};
    std::unique_ptr<Device> device(new Device);
    PELLUCID_CHECK(device->init(desc));
    return device;
}

Device::~Device() {
    if (context_.device && live_objects() > 0) {
        const std::string text = std::to_string(live_objects()) + " objects were not destroyed before their device";
        context_.log(Severity::warning, text.c_str());
    }
}

Result<void> Device::init(const rhi::DeviceDesc& desc) {
    Context& c = context_;
    c.log = desc.log;
    PELLUCID_TRY(c.instance, Instance::create(desc.validation, desc.log, desc.display.system));
    c.display = desc.display;
    PELLUCID_TRY(const Candidate candidate, c.instance->choose(desc.device));
    c.device_info = candidate.info;
    c.physical = candidate.handle;
    c.family = candidate.family;
    c.timestamp_bits = candidate.timestamp_bits;
    VkPhysicalDeviceProperties properties = {};
    c.instance->vk.GetPhysicalDeviceProperties(c.physical, &properties);
    c.limits = properties.limits;
    PELLUCID_CHECK(make_device(c, candidate));
    if (desc.count_api_calls) PELLUCID_CHECK(c.counter.install(c.vk));
    c.vk.GetDeviceQueue(c.device, c.family, 0, &c.queue);

    VkPhysicalDeviceMemoryProperties memory = {};
    c.instance->vk.GetPhysicalDeviceMemoryProperties(c.physical, &memory);
    c.memory = SubAllocator(memory, c.limits.bufferImageGranularity, {&c, allocate_memory, free_memory});
    c.pipeline_cache_file = desc.pipeline_cache;
    PELLUCID_CHECK(c.open_pipeline_cache());

    // Set layouts 0 and 1 are the empty one and group 0, for all pipelines.
    PELLUCID_TRY([[maybe_unused]] const std::uint32_t none, c.set_layout({}, false, "empty group"));
    const rhi::GroupLayout frame = {{{PELLUCID_BIND_FRAME, rhi::BindingKind::uniform_buffer},
                                     {PELLUCID_BIND_RECORDS, rhi::BindingKind::storage_buffer}}};
    PELLUCID_TRY([[maybe_unused]] const std::uint32_t first, c.set_layout(frame, true, "frame group"));
    PELLUCID_TRY(const PipelineLayout* const base, c.pipeline_layout(0, 0, "base pipeline layout"));
    c.base_layout = base->handle;
    return c.init_frames(desc.frames_in_flight);
}

std::uint32_t Device::live_objects() const {
    const Context& c = context_;
    return c.buffers.size() + c.textures.size() + c.samplers.size() + c.pipelines.size() + c.groups.size() +
           c.queries.size();
}

Error Context::fail(VkResult result, const char* what, const char* name) {
    if (result == VK_ERROR_DEVICE_LOST) lost = true;
    return api_error(result, what, name);
}

Error Context::lost_error() const {
    return {Errc::device_lost, "the device '" + device_info.name + "' was lost earlier: destroy it and make a new one"};
}

void Context::set_name(VkObjectType type, std::uint64_t handle, const char* name) const {
    VkDebugUtilsObjectNameInfoEXT naming = {VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    naming.objectType = type;
    naming.objectHandle = handle;
    naming.pObjectName = name;
    vk.SetDebugUtilsObjectNameEXT(device, &naming);
}

Context::~Context() {
    if (!device) return;
    vk.DeviceWaitIdle(device);  // fails on a lost device, whose objects may be destroyed nevertheless
    for (const Garbage& item : garbage) destroy_now(item);
    garbage.clear();
    const auto now = [this](VkObjectType type, auto handle) {
        if (handle) destroy_now({0, type, to_bits(handle), {}, {}});
    };
    buffers.for_each([&](auto, BufferObject& o) { now(VK_OBJECT_TYPE_BUFFER, o.handle); });
    textures.for_each([&](auto, TextureObject& o) {
        now(VK_OBJECT_TYPE_IMAGE_VIEW, o.sampled);
        for (VkImageView view : o.storage) now(VK_OBJECT_TYPE_IMAGE_VIEW, view);
        for (VkImageView view : o.attachment) now(VK_OBJECT_TYPE_IMAGE_VIEW, view);
        now(VK_OBJECT_TYPE_IMAGE, o.handle);
    });
    samplers.for_each([&](auto, SamplerObject& o) {
        now(VK_OBJECT_TYPE_SAMPLER, o.mipmapped);
        now(VK_OBJECT_TYPE_SAMPLER, o.one_level);
    });
    pipelines.for_each([&](auto, PipelineObject& o) { now(VK_OBJECT_TYPE_PIPELINE, o.handle); });
    queries.for_each([&](auto, QueriesObject& o) { now(VK_OBJECT_TYPE_QUERY_POOL, o.handle); });
    destroy_frames();
    destroy_upload();
    save_pipeline_cache();
    if (pipeline_cache) vk.DestroyPipelineCache(device, pipeline_cache, nullptr);
    for (const PipelineLayout& layout : pipeline_layouts) vk.DestroyPipelineLayout(device, layout.handle, nullptr);
    for (const SetLayout& layout : set_layouts) {
        for (const SetLayout::Pool& pool : layout.pools) vk.DestroyDescriptorPool(device, pool.handle, nullptr);
        if (layout.handle) vk.DestroyDescriptorSetLayout(device, layout.handle, nullptr);
    }
    memory.release_all();
    vk.DestroyDevice(device, nullptr);
}

}  // namespace pellucid::inline v0_1::vulkan
