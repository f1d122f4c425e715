// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The ways of keeping a pixel's position: stored, or rebuilt from depth.  All arithmetic that a GPU does is float;
/// vertices are placed in double and rounded once, and the last step to a common frame, eye at the origin, is double.
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <pellucid/reference/gbuffer.hpp>
#include "encodings/half_nearest.hpp"

namespace pellucid::bench {

/// What a pixel stores.  The values are those of the shader's constant.
enum class PositionStore : std::uint32_t {
    world_float = 1,  ///< world coordinates, 4 × binary32
    world_half_nearest = 2,
    world_half_truncated = 3,  ///< 4 × binary16 as GPUs store it
    depth24 = 4,               ///< unorm depth
    depth32f = 5,
};
/// Standard depth is 0 at near and 1 at far; reversed the other way round; infinite: reversed, near/−z.
enum class DepthRange { standard, reversed, infinite };

/// What becomes of a depth.
enum class PositionUse : std::uint32_t {
    relative = 0,             ///< it stays relative to the eye: `reference::view_from_depth`
    inverse_matrix = 1,       ///< world coordinates by one float matrix, the inverse of the view-projection
    added_to_the_camera = 2,  ///< the first, rotated, plus the camera's position: world coordinates again
};

struct PositionEncoding {
    const char* name;
    PositionStore store;
    DepthRange range;  ///< of depth
    PositionUse use;   ///< of depth
    double bytes;      ///< a pixel; depth is there anyway
};

inline constexpr std::array<PositionEncoding, 10> position_encodings = {{
    {"RGBA32F world", PositionStore::world_float, DepthRange::infinite, PositionUse::relative, 16},
    {"RGBA16F world, nearest", PositionStore::world_half_nearest, DepthRange::infinite, PositionUse::relative, 8},
    {"RGBA16F world, toward zero", PositionStore::world_half_truncated, DepthRange::infinite, PositionUse::relative, 8},
    {"D24 standard", PositionStore::depth24, DepthRange::standard, PositionUse::relative, 4},
    {"D32F standard", PositionStore::depth32f, DepthRange::standard, PositionUse::relative, 4},
    {"D24 reversed", PositionStore::depth24, DepthRange::reversed, PositionUse::relative, 4},
    {"D32F reversed, finite", PositionStore::depth32f, DepthRange::reversed, PositionUse::relative, 4},
    {"D32F reversed, infinite", PositionStore::depth32f, DepthRange::infinite, PositionUse::relative, 4},
    {"D32F reversed, infinite; inverse matrix", PositionStore::depth32f, DepthRange::infinite,
     PositionUse::inverse_matrix, 4},
    {"D32F reversed, infinite; camera added", PositionStore::depth32f, DepthRange::infinite,
     PositionUse::added_to_the_camera, 4},
}};

/// `clip` for a depth range between its camera's near plane and `far` [m]: x and y stay.
[[nodiscard]] inline ClipFromView with_range(ClipFromView clip, DepthRange range, double near, double far) noexcept {
    const double depth = far - near;
    clip.zz = range == DepthRange::standard ? -far / depth : range == DepthRange::reversed ? near / depth : 0;
    clip.zw = range == DepthRange::standard   ? -far * near / depth
              : range == DepthRange::reversed ? far * near / depth
                                              : near;
    return clip;
}

/// Depth in [0,1] through 24 bits of unorm, rounded exactly.
[[nodiscard]] inline float through_depth24(float depth) noexcept {
    constexpr double limit = 16777215;
    return static_cast<float>(std::floor(std::clamp(double{depth}, 0.0, 1.0) * limit + 0.5) / limit);
}

/// A view: what `through_position` needs of a camera.
struct PositionView {
    glm::dmat4 world_from_view{1.0};
    ClipFromView clip;                ///< with the range of the encoding
    glm::mat4 world_from_clip{1.0f};  ///< its inverse view-projection, computed in double and rounded

    PositionView(const Camera& camera, Extent2D size, DepthRange range, double far)
        : world_from_view(camera.world_from_view),
          clip(with_range(clip_from_view(camera, size), range, camera.near, far)) {
        const glm::dmat4 projection{
            {clip.sx, 0, 0, 0}, {0, clip.sy, 0, 0}, {0, 0, clip.zz, clip.wz}, {0, 0, clip.zw, 0}};
        world_from_clip = glm::mat4(world_from_view * glm::inverse(projection));
    }
};

/// A point in view space [m], on the ray through `ndc`, through the encoding: what comes back, in view space.  Not
/// finite where a format cannot hold it.
[[nodiscard]] inline glm::dvec3 through_position(const PositionEncoding& encoding, const PositionView& view,
                                                 glm::vec2 ndc, glm::dvec3 point) noexcept {
    const glm::dvec3 eye(view.world_from_view[3]);
    const glm::dmat3 turn(view.world_from_view);
    const auto in_view = [&](glm::vec3 world) { return glm::transpose(turn) * (glm::dvec3(world) - eye); };
    const glm::vec3 world(eye + turn * point);
    const auto each = [&](auto half) {
        return in_view({half_to_float(half(world.x)), half_to_float(half(world.y)), half_to_float(half(world.z))});
    };
    switch (encoding.store) {
        case PositionStore::world_float:
            return in_view(world);
        case PositionStore::world_half_nearest:
            return each(half_nearest);
        case PositionStore::world_half_truncated:
            return each(half_toward_zero);
        case PositionStore::depth24:
        case PositionStore::depth32f:
            break;
    }
    const reference::ClipCoefficients<float> clip(view.clip);
    float depth = reference::depth_from_view(clip, glm::vec3(point));
    if (encoding.store == PositionStore::depth24) depth = through_depth24(depth);
    if (encoding.use == PositionUse::inverse_matrix) {
        const glm::vec4 found = view.world_from_clip * glm::vec4(ndc, depth, 1.0f);
        return in_view(glm::vec3(found) / found.w);
    }
    const glm::vec3 found = reference::view_from_depth(clip, ndc, depth);
    if (encoding.use == PositionUse::relative) return glm::dvec3(found);
    return in_view(glm::mat3(turn) * found + glm::vec3(eye));
}

}  // namespace pellucid::bench
