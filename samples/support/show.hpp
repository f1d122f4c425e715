// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A demonstration in a window: the loop, whatever is drawn.
#include "window.hpp"
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/surface.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/surface.hpp>
#endif
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <chrono>
#include <cstdint>
#include <memory>

namespace pellucid::samples {

/// What a frame of a window has to go by.
struct Moment {
    double seconds = 0;  ///< [s] since the first frame
    double step = 0;     ///< [s] since the last one, at most a tenth of a second
    double dx = 0;       ///< [share of the window's height] the pointer's way since the last frame, to the right
    double dy = 0;       ///< the same, down
    double wheel = 0;    ///< notches of the wheel, away from the user
};

/// Opens a window and draws in it until it is closed, Escape is pressed, or `frames` frames are shown (0: no end).
/// `make(device, size)` gives a `Result` of a demonstration, or of a pointer to one, which has
///   `Result<void> resize(Extent2D)`                       a window of another size; not called with the same one
///   `Result<void> frame(Window&, const Moment&)`          records and submits a picture
///   `rhi::Texture picture()`                              that picture, of any size
/// Errors: those of the window, the device and the demonstration.
template <rhi::PresentingBackend B, class Make>
[[nodiscard]] Result<void> show(const WindowDesc& what, rhi::DeviceDesc desc, std::uint32_t frames, Make&& make) {
    std::unique_ptr<Window> window;
    PELLUCID_TRY(window, Window::open(what));
    desc.display = window->display();
    std::unique_ptr<typename B::Device> device;
    PELLUCID_TRY(device, B::create(desc));
    std::unique_ptr<typename B::Surface> surface;
    PELLUCID_TRY(surface, B::Surface::create(*device, {.window = window->native()}));
    Extent2D size = window->framebuffer();
    if (size.width == 0 || size.height == 0) size = what.size;
    PELLUCID_TRY(auto demo, make(*device, size));

    using Clock = std::chrono::steady_clock;
    const auto seconds_between = [](Clock::time_point a, Clock::time_point b) {
        return std::chrono::duration<double>(b - a).count();
    };
    const Clock::time_point start = Clock::now();
    Clock::time_point last = start;
    Window::Point pointer = window->mouse();
    for (std::uint32_t shown = 0; !window->closed() && (frames == 0 || shown < frames);) {
        const Extent2D now_size = window->framebuffer();
        if (now_size.width == 0 || now_size.height == 0) {
            window->wait(0.25);
            continue;
        }
        window->poll();
        if (window->down(GLFW_KEY_ESCAPE)) break;
        if (now_size != size) PELLUCID_CHECK(demo->resize(size = now_size));
        const Clock::time_point now = Clock::now();
        const Window::Point at = window->mouse();
        Moment moment{.seconds = seconds_between(start, now),
                      .step = std::min(seconds_between(last, now), 0.1),
                      .dx = (at.x - pointer.x) / size.height,
                      .dy = (at.y - pointer.y) / size.height};
        for (const WindowEvent& event : window->events())
            if (event.kind == WindowEvent::Kind::wheel) moment.wheel += event.y;
        last = now;
        pointer = at;
        PELLUCID_CHECK(demo->frame(*window, moment));
        PELLUCID_TRY(const bool presented, surface->present(demo->picture(), size));
        shown += presented ? 1 : 0;
    }
    return {};
}

}  // namespace pellucid::samples
