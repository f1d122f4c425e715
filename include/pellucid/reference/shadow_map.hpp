// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What shadow maps are made of, in double: the filter of shaders/common/shadow.glsl, its closed form at a straight
/// edge, and what cascades must hold.
///
/// A map is what a camera with reversed depth sees of what casts.  The filter is a box of 3×3 texels convolved with the
/// bilinear kernel, so its weights along an axis are (1 - f, 1, 1, f)/3 of four texels, f being the fraction of the
/// place less half a texel.  A texel lets light through where its depth is not in front of the receiver's plane at its
/// middle.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <pellucid/gpu/shadow_map.h>
#include <pellucid/scene/camera.hpp>
#include <span>

namespace pellucid::inline v0_1::reference {

/// A map and how it is looked into.
struct ShadowMapView {
    Camera camera;
    std::uint32_t size = 0;              ///< [texel] a side
    std::span<const float> depths = {};  ///< rows, row 0 at the top

    /// [texel] from the top left, of a point in world space; nothing for one that is not before the camera.
    [[nodiscard]] std::optional<glm::dvec2> texel(glm::dvec3 p) const noexcept;
};

/// Light that a straight edge lets through whose texels are lit from `texels` before the point on, in [0,1]: a ramp of
/// three texels.
[[nodiscard]] inline double edge_light(double texels) noexcept {
    return std::clamp((texels + 1.5) / 3, 0.0, 1.0);
}

/// Share of the light that gets to `p` [m, world] of a plane with this unit normal; nothing where the map does not show
/// all that the filter reads.  The bias is the filter's own but for what stands for
/// single precision.
[[nodiscard]] inline std::optional<double> filtered_light(const ShadowMapView& map, glm::dvec3 p, glm::dvec3 normal);

/// [m] the radius of the smallest sphere around the part of a view between two distances along it, whose corners are
/// `tangent` times their distance off the axis; found by search.
[[nodiscard]] inline double smallest_slice_radius(double near, double far, double tangent) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// A direction or a point in the space of a rigid camera.
[[nodiscard]] inline glm::dvec3 turned(const Camera& camera, glm::dvec3 v) noexcept {
    return glm::transpose(glm::dmat3(camera.world_from_view)) * v;
}

}  // namespace detail

inline std::optional<glm::dvec2> ShadowMapView::texel(glm::dvec3 p) const noexcept {
    const ClipFromView clip = clip_from_view(camera, {size, size});
    const glm::dvec3 q = detail::turned(camera, p - glm::dvec3(camera.world_from_view[3]));
    const double w = q.z * clip.wz + clip.ww;
    if (!(w > 0)) return std::nullopt;
    return 0.5 * size * (glm::dvec2(q.x * clip.sx, -q.y * clip.sy) / w + 1.0);
}

std::optional<double> filtered_light(const ShadowMapView& map, glm::dvec3 p, glm::dvec3 normal) {
    const ClipFromView clip = clip_from_view(map.camera, {map.size, map.size});
    const glm::dvec3 n = detail::turned(map.camera, normal);
    const glm::dvec3 q = detail::turned(map.camera, p - glm::dvec3(map.camera.world_from_view[3]));
    const double w = q.z * clip.wz + clip.ww, texel = w / (0.5 * map.size * clip.sx);
    if (!(w > 0)) return std::nullopt;
    // z = f(x, y) on the plane; rays of a perspective map spread, which tilts it in the map's eyes.
    const double facing = clip.wz == 0 ? n.z : -glm::dot(n, q) / w, over = facing > 0 ? 1 / facing : 0;
    glm::dvec2 slope(-n.x * over, -n.y * over);
    if (const double steep = glm::length(slope); steep > PELLUCID_SHADOW_MAX_SLOPE)
        slope *= PELLUCID_SHADOW_MAX_SLOPE / steep;
    const glm::dvec2 at = 0.5 * map.size * (glm::dvec2(q.x * clip.sx, -q.y * clip.sy) / w + 1.0);
    const double depth = (q.z * clip.zz + clip.zw) / w;
    const double per_metre = (clip.zz - depth * clip.wz) / w;
    const double bias = texel * (PELLUCID_SHADOW_OFFSET * std::clamp(over, 1.0, PELLUCID_SHADOW_MAX_SLOPE) +
                                 (std::abs(slope.x) + std::abs(slope.y)) / 128 + glm::dot(slope, slope) / 1024);
    const glm::dvec2 corner = glm::floor(at - 0.5), fraction = at - 0.5 - corner;
    if (corner.x < 1 || corner.y < 1 || corner.x > map.size - 3.0 || corner.y > map.size - 3.0) return std::nullopt;
    const double weights[2][4] = {{1 - fraction.x, 1, 1, fraction.x}, {1 - fraction.y, 1, 1, fraction.y}};
    double sum = 0;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            const glm::dvec2 cell = corner + glm::dvec2(column - 1, row - 1), away = cell + 0.5 - at;
            const double plane = depth + (bias + texel * (slope.x * away.x - slope.y * away.y)) * per_metre;
            const auto place = static_cast<std::size_t>(cell.y) * map.size + static_cast<std::size_t>(cell.x);
            if (map.depths[place] <= std::max(plane, 0.0)) sum += weights[0][column] * weights[1][row];
        }
    return sum / 9;
}

double smallest_slice_radius(double near, double far, double tangent) noexcept {
    // The farther of two corners as a function of the middle's distance is convex.
    const auto radius = [&](double z) {
        return std::max(std::hypot(near - z, near * tangent), std::hypot(far - z, far * tangent));
    };
    double a = near, b = far;
    for (int i = 0; i < 200; ++i) {
        const double c = a + (b - a) / 3, d = b - (b - a) / 3;
        (radius(c) <= radius(d) ? b : a) = radius(c) <= radius(d) ? d : c;
    }
    return radius(0.5 * (a + b));
}

}  // namespace pellucid::inline v0_1::reference
