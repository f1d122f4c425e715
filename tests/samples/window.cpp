// SPDX-License-Identifier: MIT
// Real windows, on whatever display there is (Xvfb in continuous integration): what the X server shows is what was
// drawn.
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/framing.hpp>
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/passes.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/passes.hpp>
#endif
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include "support/windows.hpp"

using namespace pellucid;
using namespace pellucid::test;

TEMPLATE_LIST_TEST_CASE("a window shows a texture code for code, its row 0 at the top", "[gpu][window]",
                        test::Backends) {
    using B = TestType;
    constexpr Extent2D size{161, 120};
    Shown<B> shown = open_shown<B>(size);
    if (!shown) return;
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        const Image8 image = pattern(size, frame);
        const auto texture = make_texture(*shown.device, image);
        CHECK(test::must(shown.surface->present(texture, size)));
        CHECK(shows(*shown.window, without_alpha(image)));
    }
}

TEMPLATE_LIST_TEST_CASE("a window follows twenty sizes, among them none", "[gpu][window]", test::Backends) {
    using B = TestType;
    Shown<B> shown = open_shown<B>({160, 120});
    if (!shown) return;
    constexpr Extent2D sizes[] = {{200, 100}, {1, 1},   {0, 0},     {320, 240}, {64, 200},
                                  {0, 50},    {33, 31}, {400, 300}, {2, 300},   {160, 120}};
    for (std::uint32_t step = 0; step < 20; ++step) {
        const Extent2D size = sizes[step % std::size(sizes)];
        CAPTURE(step, size.width, size.height);
        const bool empty = size.width == 0 || size.height == 0;
        if (!empty) resize(*shown.window, size);
        constexpr Extent2D some{8, 8};
        const Image8 image = pattern(empty ? some : size, step);
        const auto texture = make_texture(*shown.device, image);
        CHECK(test::must(shown.surface->present(texture, size)) == !empty);
        if (!empty) CHECK(shows(*shown.window, without_alpha(image)));
    }
}

TEMPLATE_LIST_TEST_CASE("a picture of another size than its window is stretched", "[gpu][window]", test::Backends) {
    using B = TestType;
    constexpr Extent2D size{128, 96};
    Shown<B> shown = open_shown<B>(size);
    if (!shown) return;
    // One colour a quarter: away from the seams a filter has nothing to mix.
    Image8 quarters(2, 2, 4);
    quarters.data = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 200, 100, 50, 255};
    const auto texture = make_texture(*shown.device, quarters);
    CHECK(test::must(shown.surface->present(texture, size)));
    const auto at = [&](const Image8& image, std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* t = &image.data[3 * (std::size_t{y} * image.width + x)];
        return std::array<int, 3>{t[0], t[1], t[2]};
    };
    Image8 now;
    for (int attempt = 0; attempt < 200; ++attempt) {
        now = test::window_pixels(shown.window->display().connection, shown.window->native(), size);
        if (at(now, 4, 4) == std::array{255, 0, 0}) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(at(now, 4, 4) == std::array{255, 0, 0});
    CHECK(at(now, 123, 4) == std::array{0, 255, 0});
    CHECK(at(now, 4, 91) == std::array{0, 0, 255});
    CHECK(at(now, 123, 91) == std::array{200, 100, 50});
}

TEMPLATE_LIST_TEST_CASE("two windows of one device show their own pictures", "[gpu][window]", test::Backends) {
    using B = TestType;
    constexpr Extent2D size{120, 80};
    Shown<B> first = open_shown<B>(size);
    if (!first) return;
    const auto second = open_window(size);
    glfwSetWindowPos(second->glfw(), 400, 0);  // what is covered cannot be seen
    const auto surface = test::must(B::Surface::create(*first.device, {.window = second->native(), .vsync = false}));
    for (std::uint32_t frame = 0; frame < 3; ++frame) {
        const Image8 one = pattern(size, frame), other = pattern(size, frame + 100);
        const auto a = make_texture(*first.device, one), b = make_texture(*first.device, other);
        CHECK(test::must(first.surface->present(a, size)));
        CHECK(test::must(surface->present(b, size)));
        CHECK(shows(*first.window, without_alpha(one)));
        CHECK(shows(*second, without_alpha(other)));
    }
}

TEMPLATE_LIST_TEST_CASE("a surface that cannot be, and what cannot be shown, is refused", "[gpu][window]",
                        test::Backends) {
    using B = TestType;
    constexpr Extent2D size{64, 48};
    Shown<B> shown = open_shown<B>(size);
    if (!shown) return;
    const auto encoded = make_texture(*shown.device, pattern(size, 0), rhi::Format::rgba8_srgb);
    const auto no = shown.surface->present(encoded, size);
    REQUIRE(!no);
    CHECK(no.error().code == Errc::invalid_argument);
    CHECK(no.error().message.find("rgba8_unorm") != std::string::npos);
    CHECK(!shown.surface->present({}, size));

    const auto texture = make_texture(*shown.device, pattern(size, 0));
    (void)test::must(shown.device->begin_frame());
    CHECK(!shown.surface->present(texture, size));
    test::must(shown.device->wait(test::must(shown.device->submit())));
    CHECK(test::must(shown.surface->present(texture, size)));

    const auto headless = test::make_device<B>();
    const auto without = B::Surface::create(*headless, {.window = shown.window->native()});
    REQUIRE(!without);
    CHECK(without.error().message.find("DeviceDesc::display") != std::string::npos);
}

TEMPLATE_LIST_TEST_CASE("a renderer's picture in a window is the one without", "[gpu][window]", test::Backends) {
    using B = TestType;
    constexpr Extent2D size{160, 120};
    const Scene scene = make_demo_scene();
    const Camera camera = frame_scene(scene, size);
    Shown<B> shown = open_shown<B>(size);
    if (!shown) return;
    const auto renderer = test::must(Renderer<B>::create(*shown.device, scene, {.size = size}));
    for (int frame = 0; frame < 30; ++frame) {
        (void)test::must(renderer->render(camera));
        CHECK(test::must(shown.surface->present(renderer->display(), size)));
    }
    const Image8 in_window = test::must(renderer->read_display());
    CHECK(shows(*shown.window, without_alpha(in_window)));

    const auto headless = test::make_device<B>();
    const auto alone = test::must(Renderer<B>::create(*headless, scene, {.size = size}));
    (void)test::must(alone->render(camera));
    CHECK(test::must(alone->read_display()).data == in_window.data);
}
