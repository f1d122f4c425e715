// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which views shadow maps are: a light's cascades, cone or faces as cameras, fitted to the scene.  Pure functions in
/// double; no device.
///
/// Cascades (W. Engel, "Cascaded shadow maps", ShaderX5, 2006; stable by spheres and whole texels: M. Valient, "Stable
/// rendering of cascaded shadow maps", ShaderX6, 2008): each holds a slice of what is seen in a sphere, whose radius
/// depends on distances that change in steps alone, and whose centre is rounded to texels.  So the grid of texels stays
/// where it is in the world while the camera turns, and while it moves, but for the steps: the distance of the eye to
/// the scene's far end (and to its near end) is rounded to the next power of sqrt 2.
#include <pellucid/core/small_vector.hpp>
#include <pellucid/gpu/shadow_map.h>
#include <pellucid/scene/camera.hpp>
#include <pellucid/scene/light.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace pellucid::inline v0_1 {

/// Bounds along the axes of the world [m]; empty while lower > upper.
struct WorldBox {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool empty() const noexcept { return !(lower.x <= upper.x); }
    void add(const WorldBox& b) noexcept {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    [[nodiscard]] glm::dvec3 center() const noexcept { return 0.5 * (lower + upper); }
    [[nodiscard]] double radius() const noexcept { return 0.5 * glm::length(upper - lower); }
    [[nodiscard]] glm::dvec3 corner(int i) const noexcept {
        return {(i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y, (i & 4) != 0 ? upper.z : lower.z};
    }
    /// The box around an object's box after it was placed.
    [[nodiscard]] static WorldBox placed(const glm::dvec3& lower, const glm::dvec3& upper, const glm::dmat4& world) {
        const glm::dvec3 middle(world * glm::dvec4(0.5 * (lower + upper), 1)), half = 0.5 * (upper - lower);
        const glm::dvec3 reach = glm::abs(glm::dvec3(world[0])) * half.x + glm::abs(glm::dvec3(world[1])) * half.y +
                                 glm::abs(glm::dvec3(world[2])) * half.z;
        return {middle - reach, middle + reach};
    }
};

/// What maps are fitted to.
struct ShadowScene {
    WorldBox all;      ///< of every instance: whatever may be in shadow
    WorldBox casters;  ///< of opaque and masked ones
};

/// A light's views, the finest cascade first, faces in the order of gpu/shadow_map.h.
using ShadowCameras = SmallVector<Camera, PELLUCID_SHADOW_FACES>;

/// Distances along the view at which what is seen is cut into slices, for cascades.  `eye_to_middle` is the distance of
/// the eye to the middle of a sphere around the scene, `radius` the sphere's.
struct ViewSlices {
    double ends[PELLUCID_SHADOW_CASCADES + 1] = {};
};
/// The slices for cascades of a view of the scene's sphere.
[[nodiscard]] inline ViewSlices view_slices(const Camera& camera, double eye_to_middle, double radius) {
    // Steps of half an octave: between them nothing changes while the eye moves.
    const double far = std::exp2(std::ceil(2 * std::log2(std::max(eye_to_middle + radius, 1e-6))) / 2);
    const double seen = std::max(camera.near, eye_to_middle - radius);
    double near = seen > 0 ? std::exp2(std::floor(2 * std::log2(seen)) / 2) : 0;
    ViewSlices slices;
    slices.ends[0] = near;
    slices.ends[PELLUCID_SHADOW_CASCADES] = far;
    near = std::max(near, far / 1024);
    for (int i = 1; i < PELLUCID_SHADOW_CASCADES; ++i) {
        // Between equal ratios, which give equal texels on the screen, and equal lengths (Zhang et al. 2006).
        const double part = static_cast<double>(i) / PELLUCID_SHADOW_CASCADES;
        slices.ends[i] = 0.75 * near * std::pow(far / near, part) + 0.25 * (near + (far - near) * part);
    }
    return slices;
}

/// A ball in the world [m].
struct Sphere {
    glm::dvec3 center{0, 0, 0};
    double radius = 0;
};

/// The smallest sphere around the part of a perspective view from `near` to `far`, whose corners are `tangent` times
/// their distance off the axis; in view space.
[[nodiscard]] inline Sphere slice_sphere(double near, double far, double tangent) {
    // On the axis, as far from the near corners as from the far ones, but not beyond the far end.
    const double t2 = tangent * tangent, z = std::min(far, 0.5 * (near + far) * (1 + t2));
    return {{0, 0, -z}, std::sqrt((far - z) * (far - z) + far * far * t2)};
}

namespace detail {

/// right, up, back of a camera that looks along `forward` (unit).
[[nodiscard]] inline glm::dmat3 shadow_axes(const glm::dvec3& forward) {
    const glm::dvec3 up = std::abs(forward.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(up, -forward));
    return {right, glm::cross(-forward, right), -forward};
}

[[nodiscard]] inline glm::dmat4 rigid(const glm::dmat3& axes, const glm::dvec3& origin) {
    return {glm::dvec4(axes[0], 0), glm::dvec4(axes[1], 0), glm::dvec4(axes[2], 0), glm::dvec4(origin, 1)};
}

/// A map of `size` texels that shows a sphere from along `axes[2]`, on a grid of texels that does not move with it.
[[nodiscard]] inline Camera sphere_map(const glm::dmat3& axes, const Sphere& sphere, const ShadowScene& scene,
                                       std::uint32_t size) {
    const double half = sphere.radius * size / (size - 2.0 * (PELLUCID_SHADOW_MARGIN + 1));
    const double texel = 2 * half / size;
    // Off whole numbers, so that what stands on a grid of its own has no edge along texel centres.
    constexpr double aside = 0.3183098861837907;
    const auto rounded = [&](double x) { return (std::round(x / texel - aside) + aside) * texel; };
    double top = -std::numeric_limits<double>::infinity(), bottom = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
        top = std::max(top, glm::dot(axes[2], scene.casters.corner(i)));
        bottom = std::min(bottom, glm::dot(axes[2], scene.all.corner(i)));
    }
    const double spare = 1e-3 * std::max(top - bottom, sphere.radius);
    const glm::dvec3 origin = axes[0] * rounded(glm::dot(axes[0], sphere.center)) +
                              axes[1] * rounded(glm::dot(axes[1], sphere.center)) + axes[2] * (top + spare);
    return {.projection = Projection::orthographic,
            .half_width = half,
            .half_height = half,
            .near = 0,
            .far = std::max(top - bottom, 0.0) + 2 * spare,
            .world_from_view = rigid(axes, origin)};
}

}  // namespace detail

/// The cascades of a directional light, the finest first; the last one shows all of the scene that is seen.
[[nodiscard]] inline ShadowCameras cascades(const Light& light, const Camera& camera, Extent2D picture,
                                            const ShadowScene& scene, std::uint32_t size) {
    const glm::dmat3 axes = detail::shadow_axes(light.direction);
    const Sphere whole{scene.all.center(), std::max(scene.all.radius(), 1e-6)};
    const ClipFromView clip = clip_from_view(camera, picture);
    const double tx = 1 / clip.sx, ty = 1 / clip.sy, tangent = std::sqrt(tx * tx + ty * ty);
    const glm::dvec3 eye(camera.world_from_view[3]);
    const ViewSlices slices = view_slices(camera, glm::distance(eye, whole.center), whole.radius);
    ShadowCameras out;
    for (int i = 0; i < PELLUCID_SHADOW_CASCADES; ++i) {
        Sphere seen = slice_sphere(slices.ends[i], slices.ends[i + 1], tangent);
        // A view in parallel rays sees as much of everything: one map will do.
        if (camera.projection == Projection::orthographic) {
            const double half = 0.5 * (camera.far - camera.near);
            seen = {{0, 0, -camera.near - half}, std::sqrt(tangent * tangent + half * half)};
        }
        const bool last = seen.radius >= whole.radius;
        if (last)
            seen = whole;
        else
            seen.center = glm::dvec3(camera.world_from_view * glm::dvec4(seen.center, 1));
        out.push_back(detail::sphere_map(axes, seen, scene, size));
        if (last || camera.projection == Projection::orthographic) break;
    }
    return out;
}

/// The one map of a spot (`faces` is 1), or the six of a light that shines everywhere.  What is nearer to the light
/// than a thousandth of its distance to the scene's far end, or than 1 mm, casts no shadow.
[[nodiscard]] inline ShadowCameras placed_maps(const Light& light, std::uint32_t faces, const ShadowScene& scene,
                                               std::span<const WorldBox> casters, std::uint32_t size) {
    const double wide = size / (size - 2.0 * PELLUCID_SHADOW_MARGIN);
    const double tangent = faces == 1 ? std::tan(light.outer_cone) * wide : wide;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const WorldBox& b : casters)
        nearest = std::min(nearest, glm::distance(light.position, glm::clamp(light.position, b.lower, b.upper)));
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, glm::distance(light.position, scene.all.corner(i)));
    // Distances along a map's axis are shorter, in its corners most.
    const double near = std::max({0.999 * nearest / std::sqrt(1 + 2 * tangent * tangent), farthest / 1024, 1e-3});
    Camera camera{.vertical_fov = 2 * std::atan(tangent), .near = near};
    ShadowCameras out;
    for (std::uint32_t face = 0; face < faces; ++face) {
        glm::dvec3 forward = light.direction;
        if (faces != 1) {
            forward = {0, 0, 0};
            forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1 : -1;
        }
        camera.world_from_view = detail::rigid(detail::shadow_axes(forward), light.position);
        out.push_back(camera);
    }
    return out;
}

/// Whether any of a box may be in what `map` shows, or between it and the light.
[[nodiscard]] inline bool casts_into(const WorldBox& box, const ClipFromView& clip, const glm::dmat4& map_from_world) {
    int left = 0, right = 0, below = 0, above = 0, behind = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 e(map_from_world * glm::dvec4(box.corner(i), 1));
        const double x = e.x * clip.sx, y = e.y * clip.sy, w = e.z * clip.wz + clip.ww, z = e.z * clip.zz + clip.zw;
        left += x < -w;
        right += x > w;
        below += y < -w;
        above += y > w;
        behind += z > w;
    }
    return left < 8 && right < 8 && below < 8 && above < 8 && behind < 8;
}

}  // namespace pellucid::inline v0_1
