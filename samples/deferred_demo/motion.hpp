// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where the lights and the camera of the demonstration are at a time: pure functions of it, so that any frame can be
/// drawn without the ones before.
#include "../support/cameras.hpp"
#include <pellucid/scene/scene.hpp>
#include <cmath>
#include <numbers>
#include <span>

namespace pellucid::samples {

/// [s] a turn of a light.
inline constexpr double light_turn = 12;

/// Puts the lights of make_demo_scene where they are after `seconds`: on one ellipse round the spheres, each at its own
/// height, every other one the other way round.  The ellipse passes between spheres and wall, and in front of the
/// cubes.
inline void orbit_lights(std::span<Light> lights, double seconds) {
    constexpr double tau = 2 * std::numbers::pi;
    const double turned = tau * seconds / light_turn;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const double start = tau * static_cast<double>(i) / static_cast<double>(lights.size());
        const double angle = start + (i % 2 == 0 ? turned : -turned);
        lights[i].position.x = 4.4 * std::cos(angle);
        lights[i].position.z = 1.4 + 3.3 * std::sin(angle);
    }
}

/// The camera of pictures without a window: swings round what `start` looks at, and comes closer and back.
[[nodiscard]] inline Camera glide(const Camera& start, const Bounds& bounds, double seconds) {
    OrbitCamera camera = OrbitCamera::from(start, bounds);
    const double phase = 2 * std::numbers::pi * seconds / 10;
    camera.orbit(0.35 * std::sin(phase), 0.06 * std::sin(2 * phase));
    camera.dolly(1 - 0.06 * std::sin(phase) * std::sin(phase));
    return camera.camera(start);
}

}  // namespace pellucid::samples
