// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A window with a device and a surface, and pictures whose every pixel tells where it is.
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/surface.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/surface.hpp>
#endif
#include <chrono>
#include <thread>
#include "support/gpu.hpp"
#include "support/window.hpp"
#include "support/window_pixels.hpp"

namespace pellucid::test {

using samples::Window;

/// A window, a device that presents to it and its surface; the members go in the opposite order.
template <class B>
struct Shown {
    std::unique_ptr<Window> window;
    TestDevice<B> device;
    std::unique_ptr<typename B::Surface> surface;

    explicit operator bool() const { return surface != nullptr; }
};

inline std::unique_ptr<Window> open_window(Extent2D size) {
    auto window = Window::open({.title = "window test", .size = size});
    if (!window && window.error().code == Errc::no_device) {
        skip(window.error().message, "PELLUCID_REQUIRE_DEVICES");
        return {};
    }
    return must(std::move(window));
}

template <class B>
Shown<B> open_shown(Extent2D size) {
    Shown<B> out{.window = open_window(size), .device = {}, .surface = {}};
    if (!out.window) return out;
    out.device = make_device<B>([&](rhi::DeviceDesc& desc) { desc.display = out.window->display(); });
    if (out.device)
        out.surface =
            must(B::Surface::create(*out.device, {.window = out.window->native(), .debug_name = "test window"}));
    return out;
}

/// Codes that tell every pixel from its neighbours, the top from the bottom and left from right.
inline Image8 pattern(Extent2D size, std::uint32_t seed) {
    Image8 out(size.width, size.height, 4);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            std::uint8_t* texel = &out.data[4 * (std::size_t{y} * size.width + x)];
            texel[0] = static_cast<std::uint8_t>(7 * x + seed);
            texel[1] = static_cast<std::uint8_t>(5 * y + 3 * seed);
            texel[2] = static_cast<std::uint8_t>(x * y + 11 * seed);
            texel[3] = 255;
        }
    return out;
}
inline Image8 without_alpha(const Image8& image) {
    Image8 out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size(); ++i) out.data[i] = image.data[i / 3 * 4 + i % 3];
    return out;
}

template <class D>
auto make_texture(D& device, const Image8& image, rhi::Format format = rhi::Format::rgba8_unorm) {
    return own(device, device.make_texture({.size = {image.width, image.height},
                                            .format = format,
                                            .usage = rhi::TextureUsage::sampled | rhi::TextureUsage::copy_source,
                                            .initial = std::as_bytes(std::span(image.data)),
                                            .debug_name = "picture"}));
}

/// Window systems show a picture when they like: soon.
inline bool shows(const Window& window, const Image8& expected) {
    for (int attempt = 0; attempt < 200; ++attempt) {
        const Image8 now =
            window_pixels(window.display().connection, window.native(), {expected.width, expected.height});
        if (now.data == expected.data) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

/// Waits until the window system has made a window as large as was asked.
inline void resize(Window& window, Extent2D size) {
    window.resize(size);
    for (int attempt = 0; attempt < 200 && !(window.framebuffer() == size); ++attempt) window.wait(0.01);
    REQUIRE(window.framebuffer().width == size.width);
    REQUIRE(window.framebuffer().height == size.height);
}

}  // namespace pellucid::test
