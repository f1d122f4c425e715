// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The demonstration in a window: 1 to 9 and the arrow keys choose a layer, Tab shows it alone or with all before it, 0
/// shows all there are; the pointer with a button held goes round the scene, the wheel comes closer.
#include "../support/cameras.hpp"
#include "../support/show.hpp"
#include "stage.hpp"
#include <memory>
#include <string>

namespace pellucid::samples {

template <rhi::Backend B>
class PeelingWindow {
public:
    /// `device` and `scene`, which has a camera, must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<PeelingWindow>> create(typename B::Device& device, const Scene& scene,
                                                                       Extent2D size) {
        std::unique_ptr<PeelingWindow> out(new PeelingWindow(device, scene));
        PELLUCID_CHECK(out->resize(size));
        return out;
    }

    [[nodiscard]] Result<void> resize(Extent2D size) {
        PELLUCID_TRY(stage_, PeelingStage<B>::create(device_, scene_, size));
        return {};
    }
    [[nodiscard]] rhi::Texture picture() { return stage_->display(); }

    [[nodiscard]] Result<void> frame(Window& window, const Moment& moment) {
        for (const WindowEvent& event : window.events())
            if (event.kind == WindowEvent::Kind::key && event.down) press(event.code);
        if (window.button_down(GLFW_MOUSE_BUTTON_LEFT)) camera_.orbit(4 * moment.dx, 4 * moment.dy);
        camera_.dolly(std::pow(0.9, moment.wheel));
        const Camera& lens = scene_.cameras.front();
        PELLUCID_CHECK(stage_->draw(camera_.camera(lens), choice_.range()));
        if (const std::string title = "peeling_demo: " + choice_.text(); title != title_)
            window.set_title(title_ = title);
        return {};
    }

private:
    PeelingWindow(typename B::Device& device, const Scene& scene)
        : device_(device), scene_(scene), camera_(OrbitCamera::from(scene.cameras.front(), scene_bounds(scene))) {}

    void press(int key) {
        if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) choice_.choose(static_cast<std::uint32_t>(key - GLFW_KEY_0));
        if (key == GLFW_KEY_RIGHT || key == GLFW_KEY_UP) choice_.next();
        if (key == GLFW_KEY_LEFT || key == GLFW_KEY_DOWN) choice_.previous();
        if (key == GLFW_KEY_TAB) choice_.toggle();
    }

    typename B::Device& device_;
    const Scene& scene_;
    OrbitCamera camera_;
    LayerChoice choice_;
    std::string title_;
    std::unique_ptr<PeelingStage<B>> stage_;
};

}  // namespace pellucid::samples
