// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What lists of lights are made of, in double: the sphere around what a light reaches, the part of the view behind a
/// square of pixels, and whether one reaches into the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <pellucid/core/image.hpp>
#include <pellucid/scene/camera.hpp>
#include <pellucid/scene/light.hpp>

namespace pellucid::inline v0_1::reference {

/// A sphere around all that a light reaches.
struct LightSphere {
    glm::dvec3 center{0, 0, 0};  ///< [m] view space
    double radius = 0;           ///< [m] infinite where the light has no range
};

/// The smallest sphere around the part of a ball of radius `range` that lies within a point light's or a spot's cone.
[[nodiscard]] inline LightSphere light_sphere(const Light& light, const glm::dmat4& view_from_world) {
    const auto placed = [&](const glm::dvec3& p) { return glm::dvec3(view_from_world * glm::dvec4(p, 1)); };
    const double range = light.range;
    if (!reaches_an_end(light)) return {placed(light.position), std::numeric_limits<double>::infinity()};
    if (light.kind == LightKind::point) return {placed(light.position), range};
    // Up to 45° the sphere goes through the tip and the rim of the cap; beyond it the rim is its equator.
    const double c = std::cos(light.outer_cone), s = std::sin(light.outer_cone);
    const double along = light.outer_cone < 0.25 * std::numbers::pi ? range / (2 * c) : range * c;
    const double radius = light.outer_cone < 0.25 * std::numbers::pi ? along : range * s;
    return {placed(light.position + along * light.direction), radius};
}

/// Four planes, inside where n·e + d >= 0, n unit.
struct ViewColumn {
    std::array<glm::dvec4, 4> planes{};
};

/// What is seen through `side`² pixels from `first` (top left) on, cut to the picture; at any depth.
[[nodiscard]] inline ViewColumn view_column(const Camera& camera, Extent2D size, glm::uvec2 first, std::uint32_t side) {
    const ClipFromView clip = clip_from_view(camera, size);
    const double right = std::min(first.x + side, size.width), bottom = std::min(first.y + side, size.height);
    const glm::dvec2 lower(2.0 * first.x / size.width - 1, 1 - 2.0 * bottom / size.height);
    const glm::dvec2 upper(2.0 * right / size.width - 1, 1 - 2.0 * first.y / size.height);
    // x_clip >= lower.x w_clip, and so on, with x_clip = sx e.x + ox and w_clip = wz e.z + ww.
    const auto plane = [&](int axis, double bound, double sign) {
        glm::dvec4 p(0);
        p[axis] = axis == 0 ? clip.sx : clip.sy;
        p.z = -bound * clip.wz;
        p.w = (axis == 0 ? clip.ox : clip.oy) - bound * clip.ww;
        return p * (sign / glm::length(glm::dvec3(p)));
    };
    return {{plane(0, lower.x, 1), plane(0, upper.x, -1), plane(1, lower.y, 1), plane(1, upper.y, -1)}};
}

/// Whether a sphere reaches behind no plane with all of it.  True for some that miss the column near an edge of it.
[[nodiscard]] inline bool reaches(const ViewColumn& column, const LightSphere& sphere) {
    return std::all_of(column.planes.begin(), column.planes.end(), [&](const glm::dvec4& plane) {
        return glm::dot(glm::dvec3(plane), sphere.center) + plane.w >= -sphere.radius;
    });
}

}  // namespace pellucid::inline v0_1::reference
