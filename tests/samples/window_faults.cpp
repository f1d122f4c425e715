// SPDX-License-Identifier: MIT
// What a window system may answer at any time, injected where Vulkan's functions are called.  (EGL has one answer, that
// a window is gone, and Xlib ends the process before it is heard.)
#if defined(PELLUCID_HAS_VULKAN)
#include <string>
#include <vector>
#include "support/windows.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

constexpr Extent2D size{96, 64};

/// Answers that the next calls give instead of their own, in order; then they are themselves again.
struct Answers {
    std::vector<VkResult> acquire, present, create;
    PFN_vkAcquireNextImageKHR real_acquire = nullptr;
    PFN_vkQueuePresentKHR real_present = nullptr;
    PFN_vkCreateSwapchainKHR real_create = nullptr;
    PFN_vkWaitForFences real_wait = nullptr;
    int created = 0;
    std::string order;  ///< A: an image is acquired; W: the CPU waits for the GPU

    static VkResult take(std::vector<VkResult>& answers) {
        if (answers.empty()) return VK_SUCCESS;
        const VkResult first = answers.front();
        answers.erase(answers.begin());
        return first;
    }
};
Answers answers;  // a Vulkan function is a plain C function

VKAPI_ATTR VkResult VKAPI_CALL acquire(VkDevice d, VkSwapchainKHR s, std::uint64_t t, VkSemaphore m, VkFence f,
                                       std::uint32_t* index) {
    answers.order += 'A';
    const VkResult instead = Answers::take(answers.acquire);
    if (instead < 0 || instead == VK_TIMEOUT) return instead;  // nothing was acquired
    const VkResult own = answers.real_acquire(d, s, t, m, f, index);
    return instead == VK_SUCCESS ? own : instead;
}
VKAPI_ATTR VkResult VKAPI_CALL present(VkQueue queue, const VkPresentInfoKHR* info) {
    const VkResult instead = Answers::take(answers.present);
    const VkResult own = answers.real_present(queue, info);  // also where it fails, it waits for the semaphore
    return instead == VK_SUCCESS ? own : instead;
}
VKAPI_ATTR VkResult VKAPI_CALL create(VkDevice d, const VkSwapchainCreateInfoKHR* info, const VkAllocationCallbacks* a,
                                      VkSwapchainKHR* out) {
    const VkResult instead = Answers::take(answers.create);
    if (instead != VK_SUCCESS) return instead;
    ++answers.created;
    return answers.real_create(d, info, a, out);
}

VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice d, std::uint32_t n, const VkFence* fences, VkBool32 all, std::uint64_t t) {
    answers.order += 'W';
    return answers.real_wait(d, n, fences, all, t);
}

Shown<Vulkan> open_faulty() {
    Shown<Vulkan> shown = open_shown<Vulkan>(size);
    if (!shown) return shown;
    vulkan::DeviceTable& table = *shown.device->native().table;
    answers = {.acquire = {},
               .present = {},
               .create = {},
               .real_acquire = table.AcquireNextImageKHR,
               .real_present = table.QueuePresentKHR,
               .real_create = table.CreateSwapchainKHR,
               .real_wait = table.WaitForFences,
               .order = {}};
    table.WaitForFences = wait;
    table.AcquireNextImageKHR = acquire;
    table.QueuePresentKHR = present;
    table.CreateSwapchainKHR = create;
    return shown;
}

/// The surface still shows what it is given.
void works(const Shown<Vulkan>& shown, std::uint32_t seed) {
    const Image8 image = pattern(size, seed);
    const auto texture = make_texture(*shown.device, image);
    CHECK(must(shown.surface->present(texture, size)));
    CHECK(shows(*shown.window, without_alpha(image)));
}

}  // namespace

TEST_CASE("a swapchain that no longer fits is made again, once a picture", "[gpu][window]") {
    const Shown<Vulkan> shown = open_faulty();
    if (!shown) return;
    works(shown, 1);
    CHECK(answers.created == 1);

    answers.acquire = {VK_ERROR_OUT_OF_DATE_KHR};
    works(shown, 2);  // the same picture is shown by the new one
    CHECK(answers.created == 2);

    answers.acquire = {VK_ERROR_OUT_OF_DATE_KHR, VK_ERROR_OUT_OF_DATE_KHR};
    const auto texture = make_texture(*shown.device, pattern(size, 3));
    CHECK_FALSE(must(shown.surface->present(texture, size)));
    works(shown, 4);

    answers.acquire = {VK_SUBOPTIMAL_KHR};
    const int before = answers.created;
    works(shown, 5);
    CHECK(answers.created == before);
    works(shown, 6);  // made again after the picture
    CHECK(answers.created == before + 1);

    answers.present = {VK_ERROR_OUT_OF_DATE_KHR};
    CHECK_FALSE(must(shown.surface->present(texture, size)));
    answers.present = {VK_SUBOPTIMAL_KHR};
    CHECK(must(shown.surface->present(texture, size)));
    works(shown, 7);
}

TEST_CASE("a semaphore is used again only when the copy that waited for it is done", "[gpu][window]") {
    const Shown<Vulkan> shown = open_faulty();
    if (!shown) return;
    const auto texture = make_texture(*shown.device, pattern(size, 1));
    for (int i = 0; i < 6; ++i) CHECK(must(shown.surface->present(texture, size)));
    CHECK(answers.order == "AAAWAWAWA");  // three pictures are on their way at a time
}

TEST_CASE("a window that has no image to give now is no error", "[gpu][window]") {
    const Shown<Vulkan> shown = open_faulty();
    if (!shown) return;
    works(shown, 1);
    answers.acquire = {VK_TIMEOUT};
    const auto texture = make_texture(*shown.device, pattern(size, 2));
    CHECK_FALSE(must(shown.surface->present(texture, size)));
    works(shown, 3);
}

TEST_CASE("memory that runs out while a swapchain is made is an error, and passes", "[gpu][window]") {
    const Shown<Vulkan> shown = open_faulty();
    if (!shown) return;
    const auto texture = make_texture(*shown.device, pattern(size, 1));
    answers.create = {VK_ERROR_OUT_OF_DEVICE_MEMORY};
    const auto first = shown.surface->present(texture, size);
    REQUIRE(!first);
    CHECK(first.error().code == Errc::out_of_memory);
    CHECK(first.error().message.find("test window") != std::string::npos);
    works(shown, 2);
}

TEST_CASE("a window that is gone, and a device that is lost, say so", "[gpu][window]") {
    const Shown<Vulkan> shown = open_faulty();
    if (!shown) return;
    works(shown, 1);
    const auto texture = make_texture(*shown.device, pattern(size, 2));
    answers.acquire = {VK_ERROR_SURFACE_LOST_KHR};
    const auto gone = shown.surface->present(texture, size);
    REQUIRE(!gone);
    CHECK(gone.error().code == Errc::invalid_argument);
    CHECK(gone.error().message.find("gone") != std::string::npos);
    answers.present = {VK_ERROR_DEVICE_LOST};
    const auto lost = shown.surface->present(texture, size);
    REQUIRE(!lost);
    CHECK(lost.error().code == Errc::device_lost);
    const auto later = shown.surface->present(texture, size);
    REQUIRE(!later);
    CHECK(later.error().code == Errc::device_lost);
}
#endif
