// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Cameras that a pointer and keys move: one goes round a point, one walks.  No window library is needed here.
///
/// Both are upright: `yaw` turns about the world's y axis, to the left, and `pitch` about the view's x axis, upwards;
/// at 0 and 0 they look along -z.  A lens (everything of a Camera but its place) is handed in, and comes back placed.
/// Made `from` a camera without roll they give its `world_from_view` back; of one with roll they keep where it stands
/// and looks, and stand upright.  Motions of a pointer are to the right (dx) and down (dy), as window libraries count
/// them, and the scene goes with the pointer.
#include <pellucid/scene/camera.hpp>
#include <pellucid/scene/framing.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::samples {

/// [rad] As steep as a motion makes a view.  A view made `from` a steeper camera stays as it is until it is turned.
inline constexpr double steepest_pitch = 0.5 * std::numbers::pi - 1e-3;

/// The way that an upright camera looks.
struct Facing {
    double yaw = 0, pitch = 0;  ///< [rad]

    void turn(double dx, double dy) {
        yaw = std::remainder(yaw - dx, 2.0 * std::numbers::pi);
        pitch = std::clamp(pitch - dy, -steepest_pitch, steepest_pitch);
    }
    [[nodiscard]] glm::dvec3 right() const { return {std::cos(yaw), 0, -std::sin(yaw)}; }
    [[nodiscard]] glm::dvec3 back() const {
        return {std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
    }
    [[nodiscard]] glm::dvec3 up() const {
        return {std::sin(yaw) * std::sin(pitch), std::cos(pitch), std::cos(yaw) * std::sin(pitch)};
    }
    [[nodiscard]] glm::dmat4 world_from_view(glm::dvec3 eye) const {
        return {glm::dvec4(right(), 0), glm::dvec4(up(), 0), glm::dvec4(back(), 0), glm::dvec4(eye, 1)};
    }

    /// The line of sight says yaw, but for views straight up or down, and near them badly: there, and wherever there is
    /// no roll, the view's x axis says it.
    [[nodiscard]] static Facing from(const glm::dmat4& world_from_view) {
        const glm::dvec3 right(world_from_view[0]), up(world_from_view[1]), back(world_from_view[2]);
        const double level = std::hypot(back.x, back.z);
        const bool upright = std::abs(right.y) < 1e-9 && up.y > -1e-9;
        const double yaw = upright || level < 1e-9 ? std::atan2(-right.z, right.x) : std::atan2(back.x, back.z);
        return {yaw, std::atan2(-back.y, level)};
    }
};

/// Goes round `target`, which is in the middle of the picture.
struct OrbitCamera {
    glm::dvec3 target{0, 0, 0};  ///< [m]
    double distance = 1;         ///< [m] from the target, > 0
    double yaw = 0, pitch = 0;   ///< [rad]
    /// [m] The distance at which lenses are taken as they are.  An orthographic one stays there, and shows more or less
    /// as `distance` grows or shrinks.  The near plane of a perspective one stays in its place as the camera comes
    /// closer, so that nothing is cut off that was not.
    double lens_distance = 1;

    void orbit(double dx, double dy) {  ///< [rad]
        Facing facing{yaw, pitch};
        facing.turn(dx, dy);
        yaw = facing.yaw;
        pitch = facing.pitch;
    }
    /// Moves the picture by shares of its height.
    void pan(double dx, double dy, const Camera& lens) {
        const double height = lens.projection == Projection::perspective
                                  ? 2.0 * distance * std::tan(0.5 * lens.vertical_fov)
                                  : 2.0 * lens.half_height * distance / lens_distance;
        const Facing facing{yaw, pitch};
        target += height * (dy * facing.up() - dx * facing.right());
    }
    /// `factor` > 0: below 1 comes closer.  Ends at 1e-4 and 1e4 times `lens_distance`.
    void dolly(double factor) { distance = std::clamp(distance * factor, 1e-4 * lens_distance, 1e4 * lens_distance); }

    [[nodiscard]] Camera camera(const Camera& lens) const {
        Camera out = lens;
        const Facing facing{yaw, pitch};
        if (lens.projection == Projection::perspective) {
            if (distance < lens_distance)
                out.near = std::min(lens.near, std::max(lens.near + distance - lens_distance, 1e-3 * distance));
            out.world_from_view = facing.world_from_view(target + distance * facing.back());
        } else {
            out.half_width *= distance / lens_distance;
            out.half_height *= distance / lens_distance;
            out.world_from_view = facing.world_from_view(target + lens_distance * facing.back());
        }
        return out;
    }

    /// `distance` [m] > 0 lies the target on the line of sight.
    [[nodiscard]] static OrbitCamera from(const Camera& camera, double distance) {
        const Facing facing = Facing::from(camera.world_from_view);
        const glm::dvec3 eye(camera.world_from_view[3]), back(camera.world_from_view[2]);
        return {eye - distance * back, distance, facing.yaw, facing.pitch, distance};
    }
    /// The target is the point of the line of sight that is closest to the middle of what there is, but not behind the
    /// camera: at least a tenth of the bounds' radius in front of it, and 1 m where there is nothing.
    [[nodiscard]] static OrbitCamera from(const Camera& camera, const Bounds& bounds) {
        if (bounds.empty()) return from(camera, 1.0);
        const glm::dvec3 eye(camera.world_from_view[3]), back(camera.world_from_view[2]);
        const double radius = std::max(0.5 * glm::length(bounds.upper - bounds.lower), 1e-6);
        return from(camera, std::max(glm::dot(eye - 0.5 * (bounds.lower + bounds.upper), back), 0.1 * radius));
    }
};

/// Walks, or rather flies: forward is where it looks.
struct FirstPersonCamera {
    glm::dvec3 position{0, 0, 0};  ///< [m]
    double yaw = 0, pitch = 0;     ///< [rad]
    double speed = 1;              ///< [m/s]

    void look(double dx, double dy) {  ///< [rad]
        Facing facing{yaw, pitch};
        facing.turn(dx, dy);
        yaw = facing.yaw;
        pitch = facing.pitch;
    }
    /// Each of the three in [-1,1], a share of `speed`; `up` is the world's.  Two keys at once are no faster than one.
    void move(double right, double up, double forward, double seconds) {
        const Facing facing{yaw, pitch};
        const glm::dvec3 way = right * facing.right() + up * glm::dvec3(0, 1, 0) - forward * facing.back();
        position += speed * seconds / std::max(1.0, glm::length(way)) * way;
    }

    [[nodiscard]] Camera camera(const Camera& lens) const {
        Camera out = lens;
        out.world_from_view = Facing{yaw, pitch}.world_from_view(position);
        return out;
    }
    [[nodiscard]] static FirstPersonCamera from(const Camera& camera, double speed = 1) {
        const Facing facing = Facing::from(camera.world_from_view);
        return {glm::dvec3(camera.world_from_view[3]), facing.yaw, facing.pitch, speed};
    }
};

}  // namespace pellucid::samples
