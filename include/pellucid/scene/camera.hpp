// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Where the scene is seen from.  Views look along -z of their own space, y up, in metres.
#include <pellucid/core/image.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <cmath>
#include <string>

namespace pellucid::inline v0_1 {

/// How a view shrinks with distance, or not.
enum class Projection { perspective, orthographic };

/// A glTF camera placed in the world.  Depth is reversed; a perspective far plane is infinitely far away.
struct Camera {
    Projection projection = Projection::perspective;
    double vertical_fov = 0.8;        ///< [rad] perspective: full angle, in (0, pi)
    double half_width = 1;            ///< [m] orthographic: half the width of the view ("xmag"), > 0
    double half_height = 1;           ///< [m] orthographic: half the height of the view ("ymag"), > 0
    double near = 0.1;                ///< [m] > 0 for perspective, >= 0 for orthographic
    double far = 0;                   ///< [m] orthographic: > near; perspective: ignored (infinite)
    glm::dmat4 world_from_view{1.0};  ///< rigid: rotation and translation only
    std::string name = {};
};

/// `clip = (e.x sx + ox, e.y sy + oy, e.z zz + zw, e.z wz + ww)` for a point `e` in view space: one form for both
/// projections, evaluated in this order by every shader.  `clip.z / clip.w` is 1 at `near` and 0 at the far end.
struct ClipFromView {
    double sx = 1, sy = 1, ox = 0, oy = 0;
    double zz = 0, zw = 0, wz = -1, ww = 0;
};

/// The projection of `camera` on a picture of `size`.  A perspective view keeps its vertical angle; an orthographic one
/// keeps its height and takes its width from the picture's shape.
[[nodiscard]] inline ClipFromView clip_from_view(const Camera& camera, Extent2D size) {
    const double aspect = static_cast<double>(size.width) / static_cast<double>(size.height);
    ClipFromView clip;
    if (camera.projection == Projection::perspective) {
        const double f = 1.0 / std::tan(0.5 * camera.vertical_fov);
        clip.sx = f / aspect;
        clip.sy = f;
        clip.zw = camera.near;
    } else {
        const double range = camera.far - camera.near;
        clip.sx = 1.0 / (camera.half_height * aspect);
        clip.sy = 1.0 / camera.half_height;
        clip.zz = 1.0 / range;
        clip.zw = camera.far / range;
        clip.wz = 0;
        clip.ww = 1;
    }
    return clip;
}

/// A rigid `world_from_view` that stands at `eye` and looks at `target`; `up` must not be parallel to the line of
/// sight.
[[nodiscard]] inline glm::dmat4 look_at(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up = {0, 1, 0}) {
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0), glm::dvec4(back, 0), glm::dvec4(eye, 1)};
}

/// The inverse of a rigid matrix.
[[nodiscard]] inline glm::dmat4 rigid_inverse(const glm::dmat4& m) {
    const glm::dmat3 r = glm::transpose(glm::dmat3(m));
    const glm::dvec3 t = -(r * glm::dvec3(m[3]));
    return {glm::dvec4(r[0], 0), glm::dvec4(r[1], 0), glm::dvec4(r[2], 0), glm::dvec4(t, 1)};
}

}  // namespace pellucid::inline v0_1
