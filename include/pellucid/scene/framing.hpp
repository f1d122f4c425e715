// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A camera for scenes that bring none.
#include <pellucid/scene/scene.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pellucid::inline v0_1 {

/// World-space bounds of every instance.  An empty scene has lower > upper.
struct Bounds {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
    [[nodiscard]] bool empty() const noexcept { return lower.x > upper.x; }
};

/// The bounds of the corners of every instance's box, in the world.
[[nodiscard]] inline Bounds scene_bounds(const Scene& scene) {
    Bounds b;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 p((corner & 1 ? mesh.upper : mesh.lower).x, (corner & 2 ? mesh.upper : mesh.lower).y,
                               (corner & 4 ? mesh.upper : mesh.lower).z, 1);
            const glm::dvec3 w(instance.world_from_object * p);
            b.lower = glm::min(b.lower, w);
            b.upper = glm::max(b.upper, w);
        }
    }
    return b;
}

/// A perspective camera that sees the whole scene on a picture of `size`, a little from above and from the right.
[[nodiscard]] inline Camera frame_scene(const Scene& scene, Extent2D size) {
    Camera camera;
    camera.name = "framing";
    camera.vertical_fov = 0.7;
    Bounds b = scene_bounds(scene);
    if (b.empty()) b = {glm::dvec3(-1), glm::dvec3(1)};
    const glm::dvec3 center = 0.5 * (b.lower + b.upper);
    const double radius = std::max(0.5 * glm::length(b.upper - b.lower), 1e-6);
    const double aspect = static_cast<double>(size.width) / static_cast<double>(size.height);
    const double half = std::atan(std::tan(0.5 * camera.vertical_fov) * std::min(1.0, aspect));
    const double distance = 1.02 * radius / std::sin(half);
    camera.near = std::max(distance - 1.5 * radius, 1e-3 * distance);
    camera.world_from_view = look_at(center + distance * glm::normalize(glm::dvec3(0.35, 0.3, 1.0)), center);
    return camera;
}

}  // namespace pellucid::inline v0_1
