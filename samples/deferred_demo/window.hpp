// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The demonstration in a window: W A S D walk, Q and E go down and up, Shift is faster, the pointer with a button held
/// looks round; lights go by the clock.
#include "../support/show.hpp"
#include "stage.hpp"
#include <memory>

namespace pellucid::samples {

template <rhi::Backend B>
class DeferredWindow {
public:
    /// `device` must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<DeferredWindow>> create(typename B::Device& device,
                                                                        const RenderSettings& settings) {
        PELLUCID_TRY(auto stage, DeferredStage<B>::create(device, settings));
        return std::make_unique<DeferredWindow>(std::move(stage));
    }
    explicit DeferredWindow(DeferredStage<B> stage)
        : stage_(std::move(stage)), camera_(FirstPersonCamera::from(stage_.scene().cameras.front(), 3)) {}

    [[nodiscard]] Result<void> resize(Extent2D size) { return stage_.resize(size); }
    [[nodiscard]] rhi::Texture picture() { return stage_.renderer().display(); }

    [[nodiscard]] Result<void> frame(Window& window, const Moment& moment) {
        const Camera& lens = stage_.scene().cameras.front();
        const auto axis = [&](int more, int less) { return (window.down(more) ? 1 : 0) - (window.down(less) ? 1 : 0); };
        if (window.button_down(GLFW_MOUSE_BUTTON_LEFT) || window.button_down(GLFW_MOUSE_BUTTON_RIGHT))
            camera_.look(moment.dx * lens.vertical_fov, moment.dy * lens.vertical_fov);
        const double faster = window.down(GLFW_KEY_LEFT_SHIFT) ? 4 : 1;
        camera_.move(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S),
                     faster * moment.step);
        PELLUCID_CHECK(stage_.draw(camera_.camera(lens), moment.seconds));
        return {};
    }

private:
    DeferredStage<B> stage_;
    FirstPersonCamera camera_;
};

}  // namespace pellucid::samples
