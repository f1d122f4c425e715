// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A window of a Vulkan device: its swapchain, made again whenever the window is of another size.
#include <array>
#include <memory>
#include <pellucid/rhi/surface.hpp>
#include <pellucid/vulkan/vulkan.hpp>
#include <vector>

namespace pellucid::inline v0_1::vulkan {

/// Models rhi::SurfaceOf; see rhi/surface.hpp for what the functions mean.
class Surface {
public:
    [[nodiscard]] static Result<std::unique_ptr<Surface>> create(Device& device, const rhi::SurfaceDesc& desc);
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    ~Surface();

    [[nodiscard]] Result<bool> present(rhi::Texture texture, Extent2D size);

    [[nodiscard]] VkSwapchainKHR native() const noexcept { return swapchain_; }

private:
    /// Pictures on their way to the window take turns, so that none waits for the one before it.
    struct Turn {
        VkCommandPool pool = VK_NULL_HANDLE;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;
        std::uint64_t ticket = 0;
    };
    /// An image of the swapchain.  Nothing tells when a semaphore that presenting waits for is free again but that its
    /// image is acquired anew, so each image has its own.
    struct Image {
        VkImage handle = VK_NULL_HANDLE;
        VkSemaphore copied = VK_NULL_HANDLE;
    };

    explicit Surface(Context& context) : context_(context) {}
    [[nodiscard]] Result<void> start(const rhi::SurfaceDesc& desc);
    [[nodiscard]] Result<void> choose_format();
    [[nodiscard]] Result<void> choose_mode(bool vsync);
    /// False where the window has no pixels.
    [[nodiscard]] Result<bool> make_swapchain(Extent2D size);
    void drop_images();
    /// The index of the next image; `none` where there is none to have now.
    [[nodiscard]] Result<std::uint32_t> acquire(Turn& turn);
    [[nodiscard]] Result<void> record(Turn& turn, TextureObject& texture, VkImage image);
    [[nodiscard]] Error fail(VkResult result, const char* what);

    static constexpr std::uint32_t none = ~0u;
    Context& context_;
    std::string name_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_ = {};
    VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
    VkExtent2D extent_ = {};  ///< of the swapchain
    Extent2D asked_ = {};     ///< the size that it was made for
    bool stale_ = true;       ///< it no longer fits the window
    std::vector<Image> images_;
    std::array<Turn, 3> turns_ = {};
    std::size_t turn_ = 0;
};

}  // namespace pellucid::inline v0_1::vulkan

namespace pellucid::inline v0_1 {
static_assert(rhi::PresentingBackend<Vulkan>);
}
