// SPDX-License-Identifier: MIT
#include <algorithm>
#include <pellucid/vulkan/surface.hpp>

// vulkan_xlib.h wants these three names of X11, and nothing else of it.
struct _XDisplay;
using Display = _XDisplay;
using Window = unsigned long;
using VisualID = unsigned long;
#include <vulkan/vulkan_xlib.h>

namespace pellucid::inline v0_1::vulkan {
namespace {

constexpr std::uint64_t second = 1'000'000'000;  // [ns]

VkImageMemoryBarrier2 barrier_of(VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
    return barrier;
}
VkOffset3D corner(std::uint32_t width, std::uint32_t height) {
    return {static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), 1};
}

}  // namespace

Result<std::unique_ptr<Surface>> Surface::create(Device& device, const rhi::SurfaceDesc& desc) {
    if (device.context_.display.system == rhi::WindowSystem::none) return rhi::no_display(desc.debug_name);
    std::unique_ptr<Surface> surface(new Surface(device.context_));
    PELLUCID_CHECK(surface->start(desc));
    return surface;
}

Surface::~Surface() {
    Context& c = context_;
    c.vk.DeviceWaitIdle(c.device);  // nothing else tells when the window system is done with the images
    drop_images();
    if (swapchain_) c.vk.DestroySwapchainKHR(c.device, swapchain_, nullptr);
    for (const Turn& turn : turns_) {
        if (turn.pool) c.vk.DestroyCommandPool(c.device, turn.pool, nullptr);
        if (turn.acquired) c.vk.DestroySemaphore(c.device, turn.acquired, nullptr);
    }
    if (surface_) c.instance->vk.DestroySurfaceKHR(c.instance->handle, surface_, nullptr);
}

Error Surface::fail(VkResult result, const char* what) {
    if (result == VK_ERROR_SURFACE_LOST_KHR || result == VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
        return {Errc::invalid_argument, std::string(what) + " for '" + name_ + "': the window is gone, or another " +
                                            "program presents to it; make a new surface for a new window"};
    return context_.fail(result, what, name_.c_str());
}

Result<void> Surface::start(const rhi::SurfaceDesc& desc) {
    Context& c = context_;
    const InstanceTable& vk = c.instance->vk;
    name_ = desc.debug_name;
    const auto create = reinterpret_cast<PFN_vkCreateXlibSurfaceKHR>(  // NOLINT: Vulkan's way
        c.instance->global.GetInstanceProcAddr(c.instance->handle, "vkCreateXlibSurfaceKHR"));
    if (!create) return Error{Errc::unsupported, "the Vulkan loader has no vkCreateXlibSurfaceKHR; update libvulkan1"};
    VkXlibSurfaceCreateInfoKHR info = {VK_STRUCTURE_TYPE_XLIB_SURFACE_CREATE_INFO_KHR};
    info.dpy = static_cast<Display*>(c.display.connection);
    info.window = desc.window;
    if (const VkResult r = create(c.instance->handle, &info, nullptr, &surface_))
        return fail(r, "vkCreateXlibSurfaceKHR");
    VkBool32 supported = VK_FALSE;
    if (const VkResult r = vk.GetPhysicalDeviceSurfaceSupportKHR(c.physical, c.family, surface_, &supported))
        return fail(r, "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (!supported)
        return Error{Errc::unsupported, "the device '" + c.device_info.name + "' cannot present to '" + name_ +
                                            "': choose the device that drives the display"};
    PELLUCID_CHECK(choose_format());
    PELLUCID_CHECK(choose_mode(desc.vsync));
    for (Turn& turn : turns_) {
        VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool.queueFamilyIndex = c.family;
        if (const VkResult r = c.vk.CreateCommandPool(c.device, &pool, nullptr, &turn.pool))
            return fail(r, "vkCreateCommandPool");
        VkCommandBufferAllocateInfo buffer = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        buffer.commandPool = turn.pool;
        buffer.commandBufferCount = 1;
        if (const VkResult r = c.vk.AllocateCommandBuffers(c.device, &buffer, &turn.commands))
            return fail(r, "vkAllocateCommandBuffers");
        const VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        if (const VkResult r = c.vk.CreateSemaphore(c.device, &semaphore, nullptr, &turn.acquired))
            return fail(r, "vkCreateSemaphore");
        c.set_name(VK_OBJECT_TYPE_SEMAPHORE, turn.acquired, "window image acquired");
    }
    return {};
}

/// What is shown are codes already: the swapchain must take them as they are, not encode them once more.
Result<void> Surface::choose_format() {
    Context& c = context_;
    std::uint32_t count = 0;
    c.instance->vk.GetPhysicalDeviceSurfaceFormatsKHR(c.physical, surface_, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    if (const VkResult r =
            c.instance->vk.GetPhysicalDeviceSurfaceFormatsKHR(c.physical, surface_, &count, formats.data()))
        return fail(r, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (const VkSurfaceFormatKHR& format : formats) {
        if (format.format != VK_FORMAT_B8G8R8A8_UNORM && format.format != VK_FORMAT_R8G8B8A8_UNORM) continue;
        VkFormatProperties can = {};
        c.instance->vk.GetPhysicalDeviceFormatProperties(c.physical, format.format, &can);
        if (format.colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR ||
            !(can.optimalTilingFeatures & VK_FORMAT_FEATURE_BLIT_DST_BIT))
            continue;
        format_ = format;
        return {};
    }
    return Error{Errc::unsupported, "'" + name_ + "' has no 8-bit format for sRGB codes that can be copied to, among " +
                                        std::to_string(formats.size()) + " formats"};
}

Result<void> Surface::choose_mode(bool vsync) {
    if (vsync) return {};  // FIFO, which there always is
    Context& c = context_;
    std::uint32_t count = 0;
    c.instance->vk.GetPhysicalDeviceSurfacePresentModesKHR(c.physical, surface_, &count, nullptr);
    std::vector<VkPresentModeKHR> modes(count);
    if (const VkResult r =
            c.instance->vk.GetPhysicalDeviceSurfacePresentModesKHR(c.physical, surface_, &count, modes.data()))
        return fail(r, "vkGetPhysicalDeviceSurfacePresentModesKHR");
    for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_IMMEDIATE_KHR, VK_PRESENT_MODE_MAILBOX_KHR})
        if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) {
            mode_ = wanted;
            break;
        }
    return {};
}

Result<bool> Surface::make_swapchain(Extent2D size) {
    Context& c = context_;
    VkSurfaceCapabilitiesKHR can = {};
    if (const VkResult r = c.instance->vk.GetPhysicalDeviceSurfaceCapabilitiesKHR(c.physical, surface_, &can))
        return fail(r, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    if (!(can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
        return Error{Errc::unsupported, "the images of '" + name_ + "' cannot be copied to"};
    const bool chooses = can.currentExtent.width == ~0u;  // the window takes the size of its pictures
    extent_ = chooses ? VkExtent2D{std::clamp(size.width, can.minImageExtent.width, can.maxImageExtent.width),
                                   std::clamp(size.height, can.minImageExtent.height, can.maxImageExtent.height)}
                      : can.currentExtent;
    if (extent_.width == 0 || extent_.height == 0) return false;
    VkSwapchainCreateInfoKHR info = {VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_;
    info.minImageCount = can.minImageCount + 1;
    if (can.maxImageCount) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = mode_;
    info.clipped = VK_TRUE;
    info.oldSwapchain = swapchain_;
    c.vk.DeviceWaitIdle(c.device);  // nothing else tells when the window system is done with the images
    VkSwapchainKHR made = VK_NULL_HANDLE;
    const VkResult result = c.vk.CreateSwapchainKHR(c.device, &info, nullptr, &made);
    drop_images();
    if (swapchain_)
        c.vk.DestroySwapchainKHR(c.device, swapchain_, nullptr);  // retired, whether a new one was made or not
    swapchain_ = made;
    if (result) return fail(result, "vkCreateSwapchainKHR");

    std::uint32_t count = 0;
    c.vk.GetSwapchainImagesKHR(c.device, swapchain_, &count, nullptr);
    std::vector<VkImage> handles(count);
    if (const VkResult r = c.vk.GetSwapchainImagesKHR(c.device, swapchain_, &count, handles.data()))
        return fail(r, "vkGetSwapchainImagesKHR");
    for (const VkImage handle : handles) {
        Image& image = images_.emplace_back(Image{handle});
        c.set_name(VK_OBJECT_TYPE_IMAGE, handle, name_.c_str());
        const VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        if (const VkResult r = c.vk.CreateSemaphore(c.device, &semaphore, nullptr, &image.copied))
            return fail(r, "vkCreateSemaphore");
        c.set_name(VK_OBJECT_TYPE_SEMAPHORE, image.copied, "window image copied");
    }
    asked_ = size;
    stale_ = false;
    return true;
}

void Surface::drop_images() {
    for (const Image& image : images_)
        if (image.copied) context_.vk.DestroySemaphore(context_.device, image.copied, nullptr);
    images_.clear();
}

Result<std::uint32_t> Surface::acquire(Turn& turn) {
    std::uint32_t index = none;
    const VkResult result =
        context_.vk.AcquireNextImageKHR(context_.device, swapchain_, second, turn.acquired, VK_NULL_HANDLE, &index);
    switch (result) {
        case VK_SUBOPTIMAL_KHR:
            stale_ = true;  // after this picture
            [[fallthrough]];
        case VK_SUCCESS:
            return index;
        case VK_ERROR_OUT_OF_DATE_KHR:
            stale_ = true;
            return none;
        case VK_TIMEOUT:
        case VK_NOT_READY:
            return none;
        default:
            return fail(result, "vkAcquireNextImageKHR");
    }
}

Result<void> Surface::record(Turn& turn, TextureObject& texture, VkImage image) {
    Context& c = context_;
    if (const VkResult r = c.vk.ResetCommandPool(c.device, turn.pool, 0)) return fail(r, "vkResetCommandPool");
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult r = c.vk.BeginCommandBuffer(turn.commands, &begin)) return fail(r, "vkBeginCommandBuffer");

    constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    constexpr VkPipelineStageFlags2 transfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    VkImageMemoryBarrier2 barriers[2] = {barrier_of(texture.handle, texture.sync.layout, source),
                                         barrier_of(image, VK_IMAGE_LAYOUT_UNDEFINED, to)};
    barriers[0].srcStageMask = texture.sync.write_stages | texture.sync.read_stages;
    barriers[0].srcAccessMask = texture.sync.write_access;
    barriers[1].srcStageMask = transfer;  // in which the semaphore of the image is waited for
    barriers[0].dstStageMask = barriers[1].dstStageMask = transfer;
    barriers[0].dstAccessMask = VK_ACCESS_2_TRANSFER_READ_BIT;
    barriers[1].dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    VkDependencyInfo dependency = {VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 2;
    dependency.pImageMemoryBarriers = barriers;
    c.vk.CmdPipelineBarrier2(turn.commands, &dependency);
    texture.sync = {source, transfer, 0, transfer, VK_ACCESS_2_TRANSFER_READ_BIT};

    VkImageBlit blit = {};
    blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = corner(texture.size.width, texture.size.height);
    blit.dstOffsets[1] = corner(extent_.width, extent_.height);
    const bool same = texture.size.width == extent_.width && texture.size.height == extent_.height;
    c.vk.CmdBlitImage(turn.commands, texture.handle, source, image, to, 1, &blit,
                      same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);

    VkImageMemoryBarrier2 shown = barrier_of(image, to, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    shown.srcStageMask = shown.dstStageMask = transfer;  // to which the semaphore's signal chains
    shown.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &shown;
    c.vk.CmdPipelineBarrier2(turn.commands, &dependency);
    return {};
}

Result<bool> Surface::present(rhi::Texture handle, Extent2D size) {
    Context& c = context_;
    if (c.lost) return c.lost_error();
    if (c.recording) return Error{Errc::invalid_argument, "present: submit the frame before"};
    TextureObject* const texture = c.textures.find(handle);
    if (!texture) return Error{Errc::invalid_argument, "present: the texture is not alive"};
    PELLUCID_CHECK(rhi::check_presentable(texture->format, name_.c_str()));
    if (size.width == 0 || size.height == 0) return false;

    Turn& turn = turns_[turn_];
    PELLUCID_CHECK(c.wait(turn.ticket));  // its semaphore and its commands are free again
    std::uint32_t index = none;
    for (int attempt = 0; attempt < 2 && index == none; ++attempt) {
        if (stale_ || !(size == asked_)) {
            PELLUCID_TRY(const bool made, make_swapchain(size));
            if (!made) return false;
        }
        PELLUCID_TRY(index, acquire(turn));
        if (index == none && !stale_) return false;
    }
    if (index == none) return false;
    const Image& image = images_[index];
    PELLUCID_CHECK(record(turn, *texture, image.handle));
    PELLUCID_TRY(turn.ticket, c.submit(turn.commands, turn.acquired, image.copied));
    turn_ = (turn_ + 1) % turns_.size();

    VkPresentInfoKHR info = {VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &image.copied;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index;
    const VkResult result = c.vk.QueuePresentKHR(c.queue, &info);
    if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = true;
        return result == VK_SUBOPTIMAL_KHR;
    }
    if (result) return fail(result, "vkQueuePresentKHR");
    return true;
}

}  // namespace pellucid::inline v0_1::vulkan
