// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <mutex>
#include <pellucid/vulkan/dispatch.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

/// State of one set of counting thunks.
struct CountedDevice {
    DeviceTable real;
    std::uint64_t calls = 0;
    bool used = false;
};
// A thunk is a plain C function and reaches its state only through an object with static storage.
CountedDevice counted[max_counted_devices];
std::mutex counted_mutex;

template <int slot, auto member>
struct Thunk;
template <int slot, class R, class... Arguments, R (VKAPI_PTR* DeviceTable::*member)(Arguments...)>
struct Thunk<slot, member> {
    static R VKAPI_PTR call(Arguments... arguments) {
        ++counted[slot].calls;
        return (counted[slot].real.*member)(arguments...);
    }
};

template <int slot>
void install_thunks(DeviceTable& table) {
    counted[slot].real = table;
    counted[slot].calls = 0;
#define PELLUCID_VULKAN_THUNK(function) \
    if (table.function) table.function = Thunk<slot, &DeviceTable::function>::call;
    PELLUCID_VULKAN_DEVICE_FUNCTIONS(PELLUCID_VULKAN_THUNK)
    PELLUCID_VULKAN_DEVICE_OPTIONAL(PELLUCID_VULKAN_THUNK)
#undef PELLUCID_VULKAN_THUNK
}

Error missing_function(const char* name) {
    return {Errc::internal,
            std::string("the Vulkan driver has no ") + name + ", which its version requires; update it"};
}

}  // namespace

Result<GlobalTable> load_global() {
    static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return Error{Errc::no_device,
                     "libvulkan.so.1 was not found: install the package libvulkan1 and a driver for it"};
    GlobalTable table;
    table.GetInstanceProcAddr =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));  // NOLINT: dlsym's way
    if (!table.GetInstanceProcAddr) return missing_function("vkGetInstanceProcAddr");
#define PELLUCID_VULKAN_LOAD(function)                                                                       \
    table.function = reinterpret_cast<PFN_vk##function>(table.GetInstanceProcAddr(nullptr, "vk" #function)); \
    if (!table.function) return missing_function("vk" #function);
    PELLUCID_VULKAN_GLOBAL_FUNCTIONS(PELLUCID_VULKAN_LOAD)
#undef PELLUCID_VULKAN_LOAD
    return table;
}

Result<InstanceTable> load_instance(const GlobalTable& global, VkInstance instance) {
    InstanceTable table;
#define PELLUCID_VULKAN_LOAD_OPTIONAL(function) \
    table.function = reinterpret_cast<PFN_vk##function>(global.GetInstanceProcAddr(instance, "vk" #function));
#define PELLUCID_VULKAN_LOAD(function)      \
    PELLUCID_VULKAN_LOAD_OPTIONAL(function) \
    if (!table.function) return missing_function("vk" #function);
    PELLUCID_VULKAN_INSTANCE_FUNCTIONS(PELLUCID_VULKAN_LOAD)
    PELLUCID_VULKAN_INSTANCE_OPTIONAL(PELLUCID_VULKAN_LOAD_OPTIONAL)
#undef PELLUCID_VULKAN_LOAD
#undef PELLUCID_VULKAN_LOAD_OPTIONAL
    return table;
}

Result<DeviceTable> load_device(const GlobalTable& global, const InstanceTable& vk, VkInstance instance,
                                VkDevice device) {
    DeviceTable table;
#define PELLUCID_VULKAN_LOAD(function)                                                                 \
    table.function = reinterpret_cast<PFN_vk##function>(vk.GetDeviceProcAddr(device, "vk" #function)); \
    if (!table.function) return missing_function("vk" #function);
    PELLUCID_VULKAN_DEVICE_FUNCTIONS(PELLUCID_VULKAN_LOAD)
#undef PELLUCID_VULKAN_LOAD
    // Debug utils is an extension of the instance: not every loader finds it through the device.
#define PELLUCID_VULKAN_LOAD(function)                                                                 \
    table.function = reinterpret_cast<PFN_vk##function>(vk.GetDeviceProcAddr(device, "vk" #function)); \
    if (!table.function)                                                                               \
        table.function = reinterpret_cast<PFN_vk##function>(global.GetInstanceProcAddr(instance, "vk" #function));
    PELLUCID_VULKAN_DEVICE_OPTIONAL(PELLUCID_VULKAN_LOAD)
#undef PELLUCID_VULKAN_LOAD
    return table;
}

Result<void> CallCounter::install(DeviceTable& table) {
    const std::scoped_lock lock(counted_mutex);
    static_assert(max_counted_devices == 4);
    constexpr void (*installers[])(DeviceTable&) = {install_thunks<0>, install_thunks<1>, install_thunks<2>,
                                                    install_thunks<3>};
    for (int slot = 0; slot < max_counted_devices; ++slot) {
        if (counted[slot].used) continue;
        counted[slot].used = true;
        installers[slot](table);
        slot_ = slot;
        return {};
    }
    return Error{Errc::unsupported, "count_api_calls: 4 devices are being counted already; destroy one of them"};
}

CallCounter::~CallCounter() {
    if (slot_ < 0) return;
    const std::scoped_lock lock(counted_mutex);
    counted[slot_].used = false;
}

std::uint64_t CallCounter::calls() const noexcept {
    return slot_ < 0 ? 0 : counted[slot_].calls;
}

std::string result_name(VkResult result) {
    switch (result) {
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_INCOMPLETE:
            return "VK_INCOMPLETE";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        default:
            return "VkResult " + std::to_string(static_cast<int>(result));
    }
}

Error api_error(VkResult result, const char* what, const char* name) {
    Errc code = Errc::internal;
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_MEMORY_MAP_FAILED:
        case VK_ERROR_TOO_MANY_OBJECTS:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            code = Errc::out_of_memory;
            break;
        case VK_ERROR_DEVICE_LOST:
            code = Errc::device_lost;
            break;
        case VK_ERROR_FEATURE_NOT_PRESENT:
        case VK_ERROR_EXTENSION_NOT_PRESENT:
        case VK_ERROR_LAYER_NOT_PRESENT:
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            code = Errc::unsupported;
            break;
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            code = Errc::no_device;
            break;
        default:
            break;
    }
    return {code, std::string(what) + " for '" + name + "' returned " + result_name(result)};
}

}  // namespace pellucid::inline v0_1::vulkan
