// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A window of GLFW's that knows nothing of the API which draws into it.  Key and button numbers are GLFW's.
#include <pellucid/rhi/surface.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace pellucid::samples {

struct WindowDesc {
    std::string title = "Pellucid";
    Extent2D size{1280, 720};  ///< [pixel] of the framebuffer where the display does not scale
    bool visible = true;
};

/// What happened to a window, in order.
struct WindowEvent {
    enum class Kind : std::uint8_t {
        key,        ///< `code`, `down`, `modifiers`
        character,  ///< `code`: a code point
        button,     ///< `code`, `down`, `modifiers`
        wheel,      ///< `x`, `y`
        drop,       ///< `paths`
        focus       ///< `down`: gained
    };
    Kind kind = Kind::key;
    int code = 0;
    bool down = false;
    int modifiers = 0;
    double x = 0, y = 0;
    std::vector<std::string> paths = {};
};

/// Belongs to the main thread.
class Window {
public:
    /// Errors: `no_device` where there is no display, `unsupported` where it is not X11.
    [[nodiscard]] static Result<std::unique_ptr<Window>> open(const WindowDesc& desc = {});
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// For DeviceDesc::display and SurfaceDesc::window.
    [[nodiscard]] rhi::NativeDisplay display() const;
    [[nodiscard]] std::uintptr_t native() const;

    /// Takes in what happened since the last call; `wait` also sleeps until something does, or for `seconds`.
    void poll();
    void wait(double seconds);
    /// What the last poll or wait took in.
    [[nodiscard]] const std::vector<WindowEvent>& events() const noexcept { return events_; }
    [[nodiscard]] bool closed() const;
    void close();

    [[nodiscard]] Extent2D framebuffer() const;  ///< [pixel] 0×0 while minimised
    void resize(Extent2D size);
    void set_title(const std::string& title);
    [[nodiscard]] bool focused() const;
    [[nodiscard]] bool down(int key) const;          ///< a key is held
    [[nodiscard]] bool button_down(int code) const;  ///< a mouse button is held
    struct Point {
        double x = 0, y = 0;
    };
    [[nodiscard]] Point mouse() const;  ///< [pixel] of the framebuffer, from its top left
    /// Hides the pointer and lets it move without end, for cameras that look around.
    void capture_mouse(bool captured);
    [[nodiscard]] GLFWwindow* glfw() const noexcept { return window_; }

private:
    Window() = default;
    void listen();

    GLFWwindow* window_ = nullptr;
    std::vector<WindowEvent> events_;
};

}  // namespace pellucid::samples
