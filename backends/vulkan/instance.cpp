// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <pellucid/vulkan/instance.hpp>
#include <pellucid/vulkan/vulkan.hpp>

namespace pellucid::inline v0_1::vulkan {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

template <class Structure>
struct Feature {
    const char* name;
    VkBool32 Structure::*member;
};
#define PELLUCID_FEATURE(structure, member) \
    { #member, &structure::member }
constexpr Feature<VkPhysicalDeviceFeatures> required_core[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, geometryShader),  // gl_PrimitiveID in fragment shaders
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, fragmentStoresAndAtomics),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, vertexPipelineStoresAndAtomics),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, independentBlend),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, depthClamp),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, multiDrawIndirect),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, drawIndirectFirstInstance),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, fullDrawIndexUint32),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, occlusionQueryPrecise),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, shaderStorageImageExtendedFormats),
};
constexpr Feature<VkPhysicalDeviceVulkan11Features> required_v11[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan11Features, shaderDrawParameters),
};
constexpr Feature<VkPhysicalDeviceVulkan12Features> required_v12[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan12Features, hostQueryReset),
};
constexpr Feature<VkPhysicalDeviceVulkan13Features> required_v13[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan13Features, dynamicRendering),
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan13Features, synchronization2),
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan13Features, maintenance4),
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan13Features, robustImageAccess),  // beyond its edge an image reads as 0
};
constexpr Feature<VkPhysicalDeviceFeatures> optional_core[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, imageCubeArray),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, shaderInt64),
    PELLUCID_FEATURE(VkPhysicalDeviceFeatures, shaderFloat64),
};
constexpr Feature<VkPhysicalDeviceVulkan12Features> optional_v12[] = {
    PELLUCID_FEATURE(VkPhysicalDeviceVulkan12Features, shaderBufferInt64Atomics),
};
#undef PELLUCID_FEATURE

template <class Structure, std::size_t N>
void require(const Feature<Structure> (&list)[N], const Structure& had, Structure& wanted, std::string& missing) {
    for (const auto& feature : list) {
        wanted.*feature.member = VK_TRUE;
        if (!(had.*feature.member)) missing += std::string(missing.empty() ? "" : ", ") + feature.name;
    }
}
template <class Structure, std::size_t N>
void allow(const Feature<Structure> (&list)[N], const Structure& had, Structure& wanted) {
    for (const auto& feature : list) wanted.*feature.member = had.*feature.member;
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const char* text = data->pMessage ? data->pMessage : "";
    const bool error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    (*static_cast<const LogSink*>(user))(error ? Severity::error : Severity::warning, text);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(LogSink& log) {
    VkDebugUtilsMessengerCreateInfoEXT info = {VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = on_message;
    info.pUserData = &log;
    return info;
}

/// Sets one environment variable while it lives.
class ScopedEnvironment {
public:
    ScopedEnvironment(const char* name, const std::string& added) : name_(name) {
        const char* old = std::getenv(name);
        had_ = old != nullptr;
        if (old) old_ = old;
        setenv(name, (had_ && !old_.empty() ? old_ + ":" + added : added).c_str(), 1);
    }
    ScopedEnvironment(const ScopedEnvironment&) = delete;
    ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;
    ~ScopedEnvironment() { had_ ? setenv(name_, old_.c_str(), 1) : unsetenv(name_); }

private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

bool has_layer(const GlobalTable& global, const char* name) {
    std::uint32_t count = 0;
    global.EnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    global.EnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [&](auto& layer) { return !std::strcmp(layer.layerName, name); });
}
bool has_extension(const std::vector<VkExtensionProperties>& list, const char* name) {
    return std::any_of(list.begin(), list.end(), [&](auto& e) { return !std::strcmp(e.extensionName, name); });
}

std::string version_name(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}
std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}
int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 0;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 1;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 3;
        default:
            return 4;
    }
}

Candidate describe(const InstanceTable& vk, VkPhysicalDevice physical) {
    Candidate c;
    c.handle = physical;
    VkPhysicalDeviceProperties basic = {};
    vk.GetPhysicalDeviceProperties(physical, &basic);
    c.type = basic.deviceType;
    c.info.backend = Vulkan::name;
    c.info.name = basic.deviceName;
    c.info.api = version_name(basic.apiVersion);
    c.info.software = basic.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (c.info.name.find("llvmpipe") != std::string::npos) c.info.max_loop_turns = rhi::llvmpipe_loop_turns;
    c.info.max_texture_size = basic.limits.maxImageDimension2D;
    c.info.max_array_layers = basic.limits.maxImageArrayLayers;
    c.info.max_storage_buffer_bytes = basic.limits.maxStorageBufferRange;
    if (basic.apiVersion < VK_API_VERSION_1_3) {
        c.info.driver = std::to_string(basic.driverVersion);
        c.info.missing = "Vulkan 1.3 (it has " + c.info.api + ")";
        return c;
    }
    VkPhysicalDeviceDriverProperties driver = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vk.GetPhysicalDeviceProperties2(physical, &properties);
    c.info.driver = std::string(driver.driverName) + " " + driver.driverInfo;

    std::uint32_t count = 0;
    vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.EnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    c.interlock = has_extension(extensions, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME);
    c.swapchain = has_extension(extensions, VK_KHR_SWAPCHAIN_EXTENSION_NAME);

    Features had, wanted;
    had.chain(c.interlock);
    vk.GetPhysicalDeviceFeatures2(physical, &had.core);
    c.info.missing = choose_features(had, wanted);
    c.info.float32_blending = true;
    for (const VkFormat format : {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}) {
        VkFormatProperties can = {};
        vk.GetPhysicalDeviceFormatProperties(physical, format, &can);
        if (!(can.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT))
            c.info.float32_blending = false;
    }
    c.info.int64_atomics = had.core.features.shaderInt64 && had.v12.shaderBufferInt64Atomics;
    c.info.pixel_ordering = c.interlock && had.interlock.fragmentShaderPixelInterlock;
    c.interlock = c.info.pixel_ordering;

    vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    const auto family = std::find_if(families.begin(), families.end(), [](const auto& f) {
        constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
        return f.queueCount > 0 && (f.queueFlags & needed) == needed;
    });
    if (family == families.end()) {
        c.info.missing += std::string(c.info.missing.empty() ? "" : ", ") + "a queue for graphics and compute";
    } else {
        c.family = static_cast<std::uint32_t>(family - families.begin());
        c.timestamp_bits = family->timestampValidBits;
        if (c.timestamp_bits) c.info.timestamp_ns = static_cast<double>(basic.limits.timestampPeriod);
    }
    return c;
}

}  // namespace

Features::Features() {
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    interlock.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_INTERLOCK_FEATURES_EXT;
}

void Features::chain(bool with_interlock) {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    v13.pNext = with_interlock ? &interlock : nullptr;
}

std::string choose_features(const Features& had, Features& wanted) {
    std::string missing;
    require(required_core, had.core.features, wanted.core.features, missing);
    require(required_v11, had.v11, wanted.v11, missing);
    require(required_v12, had.v12, wanted.v12, missing);
    require(required_v13, had.v13, wanted.v13, missing);
    allow(optional_core, had.core.features, wanted.core.features);
    allow(optional_v12, had.v12, wanted.v12);
    wanted.interlock.fragmentShaderPixelInterlock = had.interlock.fragmentShaderPixelInterlock;
    return missing.empty() ? missing : "the features " + missing;
}

Result<std::unique_ptr<Instance>> Instance::create(bool validation, LogSink log, rhi::WindowSystem windows) {
    PELLUCID_TRY(const GlobalTable global, load_global());
    std::uint32_t version = 0;
    global.EnumerateInstanceVersion(&version);
    if (version < VK_API_VERSION_1_3)
        return Error{Errc::no_device, "the Vulkan loader has version " + version_name(version) +
                                          ", below 1.3: update the package libvulkan1"};
    if (validation && !has_layer(global, validation_layer))
        return Error{Errc::unsupported, std::string("validation was asked for, but the layer ") + validation_layer +
                                            " is not installed: install the package vulkan-validationlayers"};
    std::unique_ptr<Instance> made(new Instance);
    made->global = global;
    made->log = log;
    made->windows = windows;

    std::uint32_t count = 0;
    global.EnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    global.EnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    made->debug_utils = validation || has_extension(extensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    SmallVector<const char*, 3> wanted;
    if (made->debug_utils) wanted.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (windows == rhi::WindowSystem::x11) {
        for (const char* name : {VK_KHR_SURFACE_EXTENSION_NAME, "VK_KHR_xlib_surface"}) {
            if (!has_extension(extensions, name))
                return Error{Errc::unsupported,
                             std::string("windows of X11 were asked for, and the Vulkan loader has no ") + name +
                                 ": install a driver with X11, e.g. mesa-vulkan-drivers"};
            wanted.push_back(name);
        }
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(made->log);
    const VkValidationFeatureEnableEXT enable = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features = {VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enable;
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pEngineName = "pellucid";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = static_cast<std::uint32_t>(wanted.size());
    info.ppEnabledExtensionNames = wanted.begin();
    VkResult result = VK_SUCCESS;
    if (validation) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        const ScopedEnvironment across_submits("VK_LAYER_ENABLES",
                                               "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT");
        result = global.CreateInstance(&info, nullptr, &made->handle);
    } else {
        result = global.CreateInstance(&info, nullptr, &made->handle);
    }
    if (result != VK_SUCCESS) return api_error(result, "vkCreateInstance", "pellucid");
    PELLUCID_TRY(made->vk, load_instance(global, made->handle));
    if (validation && made->vk.CreateDebugUtilsMessengerEXT) {
        result = made->vk.CreateDebugUtilsMessengerEXT(made->handle, &messenger, nullptr, &made->messenger_);
        if (result != VK_SUCCESS) return api_error(result, "vkCreateDebugUtilsMessengerEXT", "pellucid");
    }
    return made;
}

Instance::~Instance() {
    if (!handle || !vk.DestroyInstance) return;
    if (messenger_) vk.DestroyDebugUtilsMessengerEXT(handle, messenger_, nullptr);
    vk.DestroyInstance(handle, nullptr);
}

std::vector<Candidate> Instance::candidates() const {
    std::uint32_t count = 0;
    vk.EnumeratePhysicalDevices(handle, &count, nullptr);
    std::vector<VkPhysicalDevice> physical(count);
    vk.EnumeratePhysicalDevices(handle, &count, physical.data());
    std::vector<Candidate> found;
    for (std::uint32_t i = 0; i < count; ++i) {
        found.push_back(describe(vk, physical[i]));
        std::string& missing = found.back().info.missing;
        if (windows != rhi::WindowSystem::none && !found.back().swapchain)
            missing += std::string(missing.empty() ? "" : ", ") + VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    }
    return found;
}

Result<Candidate> Instance::choose(const std::string& which) const {
    const std::vector<Candidate> found = candidates();
    const bool is_index = !which.empty() && which.find_first_not_of("0123456789") == std::string::npos;
    std::string text;
    const Candidate* best = nullptr;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Candidate& c = found[i];
        const bool asked = which.empty() || (is_index ? which == std::to_string(i)
                                                      : lower(c.info.name).find(lower(which)) != std::string::npos);
        text += (i ? "; " : "") + std::to_string(i) + ": " + c.info.name +
                (c.info.missing.empty() ? " (usable)" : " (lacks " + c.info.missing + ")");
        if (asked && c.info.missing.empty() && (!best || rank(c.type) < rank(best->type))) best = &c;
    }
    if (best) return *best;
    if (found.empty())
        return Error{Errc::no_device, "Vulkan found no device: install a driver, e.g. mesa-vulkan-drivers"};
    return Error{Errc::no_device,
                 "no usable Vulkan device" + (which.empty() ? "" : " matches '" + which + "'") + "; found " + text};
}

}  // namespace pellucid::inline v0_1::vulkan

namespace pellucid::inline v0_1 {

std::vector<rhi::DeviceInfo> Vulkan::list() {
    std::vector<rhi::DeviceInfo> infos;
    auto instance = vulkan::Instance::create(false, {});
    if (!instance) return infos;
    for (vulkan::Candidate& candidate : (*instance)->candidates()) infos.push_back(std::move(candidate.info));
    return infos;
}

}  // namespace pellucid::inline v0_1
