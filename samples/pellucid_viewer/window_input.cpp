// SPDX-License-Identifier: MIT
#include "window_input.hpp"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace pellucid::samples::viewer {

Input input_of(const Window& window, double seconds) {
    const Window::Point at = window.mouse();
    Input input{.seconds = seconds, .x = static_cast<float>(at.x), .y = static_cast<float>(at.y)};
    input.left = window.button_down(GLFW_MOUSE_BUTTON_LEFT);
    input.right = window.button_down(GLFW_MOUSE_BUTTON_RIGHT);
    input.middle = window.button_down(GLFW_MOUSE_BUTTON_MIDDLE);
    const auto way = [&](int forth, int back) {
        return (window.down(forth) ? 1.0 : 0.0) - (window.down(back) ? 1.0 : 0.0);
    };
    input.move_right = way(GLFW_KEY_D, GLFW_KEY_A);
    input.move_up = way(GLFW_KEY_E, GLFW_KEY_Q);
    input.move_forward = way(GLFW_KEY_W, GLFW_KEY_S);
    input.fast = window.down(GLFW_KEY_LEFT_SHIFT);
    for (const WindowEvent& event : window.events()) {
        switch (event.kind) {
            case WindowEvent::Kind::key:
                input.toggle_ui = input.toggle_ui || (event.down && event.code == GLFW_KEY_F1);
                input.screenshot = input.screenshot || (event.down && event.code == GLFW_KEY_F12);
                break;
            case WindowEvent::Kind::button:
                // A click that was over before this frame is a click all the same.
                if (event.down && event.code == GLFW_MOUSE_BUTTON_LEFT) input.left = true;
                break;
            case WindowEvent::Kind::wheel:
                input.wheel += static_cast<float>(event.y);
                break;
            case WindowEvent::Kind::drop:
                input.dropped.insert(input.dropped.end(), event.paths.begin(), event.paths.end());
                break;
            case WindowEvent::Kind::character:
            case WindowEvent::Kind::focus:
                break;
        }
    }
    return input;
}

}  // namespace pellucid::samples::viewer
