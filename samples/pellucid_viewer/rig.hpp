// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The viewer's camera: one of the scene's, moved by hand.
#include "../support/cameras.hpp"
#include "choices.hpp"
#include "input.hpp"
#include <string>
#include <vector>

namespace pellucid::samples::viewer {

class Rig {
public:
    /// A new scene: its cameras, or one that frames it on a picture of `size`.
    void start(const Scene& scene, Extent2D size) {
        bounds_ = scene_bounds(scene);
        cameras_ = scene.cameras;
        cameras_.push_back(frame_scene(scene, {std::max(size.width, 1u), std::max(size.height, 1u)}));
        if (scene.cameras.empty()) cameras_.front().name = "framing";
        names_.clear();
        for (std::size_t i = 0; i < cameras_.size(); ++i)
            names_.push_back(cameras_[i].name.empty() ? "camera " + std::to_string(i) : cameras_[i].name);
        choose(0);
    }
    /// Back to where the scene has it.
    void choose(std::size_t index) {
        chosen_ = index;
        camera_ = cameras_[index];
        take_up();
        touched_ = false;
        rest_ = 0;
    }
    /// Moves by what a person did on a picture of this height; `over_picture`: the pointer is there and not on the
    /// panel.
    void move(const Input& input, Motion motion, Extent2D size, bool over_picture) {
        if (motion != motion_) {
            motion_ = motion;
            take_up();
        }
        const double dx = input.x - last_x_, dy = input.y - last_y_;
        last_x_ = input.x, last_y_ = input.y;
        const bool button = input.left || input.right || input.middle;
        dragging_ = button && (dragging_ || (over_picture && !held_));
        held_ = button;
        bool moved = false;
        if (dragging_ && (dx != 0 || dy != 0) && size.height > 0) {
            const double share = 1.0 / size.height;
            if (motion == Motion::walk)
                walk_.look(2 * dx * share, 2 * dy * share);
            else if (input.left)
                orbit_.orbit(4 * dx * share, 4 * dy * share);
            else
                orbit_.pan(dx * share, dy * share, lens_);
            moved = true;
        }
        if (over_picture && input.wheel != 0) {
            if (motion == Motion::walk)
                walk_.speed *= std::pow(1.2, static_cast<double>(input.wheel));
            else
                orbit_.dolly(std::pow(0.9, static_cast<double>(input.wheel)));
            moved = moved || motion == Motion::orbit;
        }
        if (motion == Motion::walk && (input.move_right != 0 || input.move_up != 0 || input.move_forward != 0)) {
            walk_.move(input.move_right, input.move_up, input.move_forward, input.seconds * (input.fast ? 5 : 1));
            moved = true;
        }
        rest_ = moved ? 0 : rest_ + input.seconds;
        if (!moved) return;
        touched_ = true;
        camera_ = motion == Motion::walk ? walk_.camera(lens_) : orbit_.camera(lens_);
    }

    [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
    [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
    [[nodiscard]] std::size_t chosen() const noexcept { return chosen_; }
    [[nodiscard]] bool touched() const noexcept { return touched_; }  ///< it is not where the scene has it
    [[nodiscard]] double rest() const noexcept { return rest_; }      ///< [s] since it was moved

private:
    /// Goes on from where the camera stands.
    void take_up() {
        lens_ = camera_;
        orbit_ = OrbitCamera::from(camera_, bounds_);
        const double radius = bounds_.empty() ? 1 : 0.5 * glm::length(bounds_.upper - bounds_.lower);
        walk_ = FirstPersonCamera::from(camera_, std::max(0.3 * radius, 1e-6));
    }

    Bounds bounds_;
    std::vector<Camera> cameras_;
    std::vector<std::string> names_;
    std::size_t chosen_ = 0;
    Camera camera_, lens_;
    OrbitCamera orbit_;
    FirstPersonCamera walk_;
    Motion motion_ = Motion::orbit;
    double last_x_ = 0, last_y_ = 0, rest_ = 0;
    bool dragging_ = false, held_ = false, touched_ = false;
};

}  // namespace pellucid::samples::viewer
