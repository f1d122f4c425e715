// SPDX-License-Identifier: MIT
#include "support/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

// glfw3native.h would pull in all of X11, and Xrandr's headers, for these two: a Display* and a Window.
extern "C" void* glfwGetX11Display(void);
extern "C" unsigned long glfwGetX11Window(GLFWwindow* window);

namespace pellucid::samples {
namespace {

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason was given";
}

int windows_open = 0;

Result<void> start_glfw() {
    if (windows_open == 0) {
#if GLFW_VERSION_MAJOR > 3 || GLFW_VERSION_MINOR >= 4
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);  // on Wayland by way of Xwayland
#endif
        if (!glfwInit())
            return Error{Errc::no_device, "no window can be opened (" + last_error() +
                                              "): set DISPLAY, run under xvfb-run, or draw without a window"};
    }
    ++windows_open;
    return {};
}

std::vector<WindowEvent>& events_of(GLFWwindow* window) {
    return *static_cast<std::vector<WindowEvent>*>(glfwGetWindowUserPointer(window));
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const WindowDesc& desc) {
    PELLUCID_CHECK(start_glfw());
    std::unique_ptr<Window> window(new Window);
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_VISIBLE, desc.visible ? GLFW_TRUE : GLFW_FALSE);
    window->window_ = glfwCreateWindow(static_cast<int>(desc.size.width), static_cast<int>(desc.size.height),
                                       desc.title.c_str(), nullptr, nullptr);
    if (!window->window_)
        return Error{Errc::unsupported, "a window of " + std::to_string(desc.size.width) + "x" +
                                            std::to_string(desc.size.height) + " could not be opened: " + last_error()};
    window->listen();
    return window;
}

Window::~Window() {
    if (window_) glfwDestroyWindow(window_);
    if (--windows_open == 0) glfwTerminate();
}

void Window::listen() {
    glfwSetWindowUserPointer(window_, &events_);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int modifiers) {
        events_of(w).push_back({WindowEvent::Kind::key, key, action != GLFW_RELEASE, modifiers});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned code) {
        events_of(w).push_back({.kind = WindowEvent::Kind::character, .code = static_cast<int>(code)});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int modifiers) {
        events_of(w).push_back({WindowEvent::Kind::button, button, action != GLFW_RELEASE, modifiers});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        events_of(w).push_back({.kind = WindowEvent::Kind::wheel, .x = x, .y = y});
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
        events_of(w).push_back({.kind = WindowEvent::Kind::focus, .down = focused != 0});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        events_of(w).push_back({.kind = WindowEvent::Kind::drop, .paths = {paths, paths + count}});
    });
}

rhi::NativeDisplay Window::display() const {
    return {rhi::WindowSystem::x11, glfwGetX11Display()};
}
std::uintptr_t Window::native() const {
    return glfwGetX11Window(window_);
}

void Window::poll() {
    events_.clear();
    glfwPollEvents();
}
void Window::wait(double seconds) {
    events_.clear();
    glfwWaitEventsTimeout(seconds);
}
bool Window::closed() const {
    return glfwWindowShouldClose(window_) != 0;
}
void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

Extent2D Window::framebuffer() const {
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return {0, 0};
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}
void Window::resize(Extent2D size) {
    glfwSetWindowSize(window_, static_cast<int>(size.width), static_cast<int>(size.height));
}
void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}
bool Window::focused() const {
    return glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0;
}
bool Window::down(int key) const {
    return glfwGetKey(window_, key) == GLFW_PRESS;
}
bool Window::button_down(int code) const {
    return glfwGetMouseButton(window_, code) == GLFW_PRESS;
}

Window::Point Window::mouse() const {
    Point at;
    glfwGetCursorPos(window_, &at.x, &at.y);
    int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixels_x, &pixels_y);
    if (width > 0 && height > 0) at = {at.x * pixels_x / width, at.y * pixels_y / height};
    return at;
}
void Window::capture_mouse(bool captured) {
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

}  // namespace pellucid::samples
