// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of sort_conflicts.hpp.
#include <pellucid/scene/sort_conflicts.hpp>
#include <pellucid/scene/detail/mesh_shape.hpp>
#include <glm/matrix.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pellucid::inline v0_1 {
namespace detail {

/// What an instance covers, seen from the camera; the margins for rounding are in it.
struct ViewBounds {
    std::uint32_t instance = 0;
    double nearest = 0, farthest = 0;     ///< [m] along the line of sight
    glm::dvec2 lower{0, 0}, upper{0, 0};  ///< normalised device coordinates, within the picture
};

/// Nothing where the instance is outside of the picture.
[[nodiscard]] inline std::optional<ViewBounds> view_bounds(const Mesh& mesh, const glm::dmat4& view_from_object,
                                                           const Camera& camera, Extent2D size) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const ClipFromView clip = clip_from_view(camera, size);
    glm::dvec3 corners[8];
    double largest = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 p((i & 1 ? mesh.upper : mesh.lower).x, (i & 2 ? mesh.upper : mesh.lower).y,
                           (i & 4 ? mesh.upper : mesh.lower).z, 1);
        corners[i] = glm::dvec3(view_from_object * p);
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(corners[i][c]));
        if (!std::isfinite(corners[i].x + corners[i].y + corners[i].z))
            return ViewBounds{.nearest = -infinity, .farthest = infinity, .lower{-1, -1}, .upper{1, 1}};
    }
    const glm::dvec2 pixel(2.0 / size.width, 2.0 / size.height);
    ViewBounds b{.nearest = infinity, .farthest = -infinity, .lower{infinity, infinity}, .upper{-infinity, -infinity}};
    const auto add = [&](const glm::dvec3& e) {
        const double w = e.z * clip.wz + clip.ww;
        const glm::dvec2 at((e.x * clip.sx + clip.ox) / w, (e.y * clip.sy + clip.oy) / w);
        b.nearest = std::min(b.nearest, -e.z);
        b.farthest = std::max(b.farthest, -e.z);
        b.lower = glm::min(b.lower, at);
        b.upper = glm::max(b.upper, at);
    };
    const auto in_front = [&](const glm::dvec3& e) { return -e.z >= camera.near; };
    for (int i = 0; i < 8; ++i) {
        if (in_front(corners[i])) add(corners[i]);
        for (const int axis : {1, 2, 4}) {
            const glm::dvec3 &a = corners[i], &z = corners[i | axis];
            if ((i & axis) != 0 || in_front(a) == in_front(z)) continue;
            glm::dvec3 cut = a + (z - a) * ((camera.near + a.z) / (a.z - z.z));
            cut.z = -camera.near;
            add(cut);
        }
    }
    const bool far_ends = camera.projection == Projection::orthographic;
    if (b.nearest > b.farthest || (far_ends && b.nearest > camera.far)) return std::nullopt;
    const double margin = 1e-6 * std::max(largest, far_ends ? camera.far - camera.near : 0.0);
    b.nearest -= margin;
    b.farthest += margin;
    b.lower = glm::max(b.lower - pixel / 64.0, glm::dvec2(-1));
    b.upper = glm::min(b.upper + pixel / 64.0, glm::dvec2(1));
    if (glm::any(glm::greaterThan(b.lower, b.upper))) return std::nullopt;
    return b;
}

/// Nothing where the matrix cannot be inverted well enough to tell on which side of a plane the eye is.
[[nodiscard]] inline std::optional<Eye> eye_in_object(const Camera& camera, const glm::dmat4& world_from_object) {
    const glm::dmat3 axes(world_from_object), inverse = glm::inverse(axes), one = axes * inverse;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            if (!(std::abs(one[c][r] - (c == r)) < 1e-11)) return std::nullopt;
    if (camera.projection == Projection::orthographic) return Eye{inverse * glm::dvec3(camera.world_from_view[2]), 0};
    return Eye{inverse * glm::dvec3(camera.world_from_view[3] - world_from_object[3]), 1};
}

inline void find_pairs(std::vector<ViewBounds>& visible, SortConflicts& out) {
    constexpr std::uint64_t most_comparisons = std::uint64_t{1} << 25;  // some tenths of a second
    constexpr std::size_t most_kept = 64 * SortConflicts::most_listed;
    std::sort(visible.begin(), visible.end(), [](const ViewBounds& a, const ViewBounds& b) {
        return std::tuple(a.nearest, a.instance) < std::tuple(b.nearest, b.instance);
    });
    std::uint64_t comparisons = 0;
    for (std::size_t i = 0; i < visible.size() && out.complete; ++i)
        for (std::size_t j = i + 1; j < visible.size() && visible[j].nearest <= visible[i].farthest; ++j) {
            if (++comparisons > most_comparisons) {
                out.complete = false;
                break;
            }
            const ViewBounds &a = visible[i], &b = visible[j];
            if (glm::any(glm::greaterThan(a.lower, b.upper)) || glm::any(glm::greaterThan(b.lower, a.upper))) continue;
            ++out.pair_count;
            if (out.pairs.size() < most_kept)
                out.pairs.push_back({std::min(a.instance, b.instance), std::max(a.instance, b.instance)});
        }
    std::sort(out.pairs.begin(), out.pairs.end(), [](const SortConflicts::Pair& a, const SortConflicts::Pair& b) {
        return std::tuple(a.first, a.second) < std::tuple(b.first, b.second);
    });
    out.pairs.resize(std::min(out.pairs.size(), SortConflicts::most_listed));
}

}  // namespace detail

PELLUCID_INLINE SortConflicts find_sort_conflicts(const Scene& scene, const Camera& camera, Extent2D size) {
    // A rigid matrix: the transpose turns back, and the eye is taken off before anything is turned.
    const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(camera.world_from_view));
    const glm::dvec3 eye(camera.world_from_view[3]);
    SortConflicts out;
    std::vector<detail::ViewBounds> visible;
    std::vector<std::optional<detail::MeshShape>> shapes(scene.meshes.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (scene.materials[mesh.material].alpha_mode != AlphaMode::blend || mesh.indices.empty()) continue;
        const glm::dmat4& world_from_object = instance.world_from_object;
        glm::dmat4 view_from_object(view_from_world * glm::dmat3(world_from_object));
        view_from_object[3] = glm::dvec4(view_from_world * (glm::dvec3(world_from_object[3]) - eye), 1);
        std::optional<detail::ViewBounds> bounds = detail::view_bounds(mesh, view_from_object, camera, size);
        if (!bounds) continue;
        bounds->instance = i;
        visible.push_back(*bounds);
        std::optional<detail::MeshShape>& shape = shapes[instance.mesh];
        if (!shape) shape = detail::mesh_shape(mesh);
        const std::optional<detail::Eye> from = detail::eye_in_object(camera, world_from_object);
        if (detail::proved_in_order(*shape, from ? &*from : nullptr)) continue;
        ++out.self_count;
        if (out.self_overlapping.size() < SortConflicts::most_listed) out.self_overlapping.push_back(i);
    }
    out.instances = static_cast<std::uint32_t>(visible.size());
    detail::find_pairs(visible, out);
    return out;
}

PELLUCID_INLINE std::string to_text(const SortConflicts& conflicts) {
    if (conflicts.exact()) return {};
    constexpr std::size_t named = 3;
    std::string pairs, selves;
    for (std::size_t i = 0; i < std::min(conflicts.pairs.size(), named); ++i)
        pairs += (i ? ", " : "") + std::to_string(conflicts.pairs[i].first) + " and " +
                 std::to_string(conflicts.pairs[i].second);
    if (conflicts.pair_count > named) pairs += ", ...";
    for (std::size_t i = 0; i < std::min(conflicts.self_overlapping.size(), named); ++i)
        selves += (i ? ", " : "") + std::to_string(conflicts.self_overlapping[i]);
    if (conflicts.self_count > named) selves += ", ...";
    std::string text = "object sorting cannot be exact here, as far as bounds and shapes tell: of " +
                       std::to_string(conflicts.instances) + " translucent instances ";
    if (!conflicts.complete) text += "too many share depths to compare them all; ";
    if (conflicts.pair_count > 0)
        text += std::string(conflicts.complete ? "" : "at least ") + std::to_string(conflicts.pair_count) +
                (conflicts.pair_count == 1 ? " pair overlaps" : " pairs overlap") + " in depth and on screen (" +
                pairs + ")";
    if (conflicts.self_count > 0)
        text += (conflicts.pair_count > 0 ? ", and " : "") + std::to_string(conflicts.self_count) +
                " may overlap themselves (" + selves + ")";
    return text;
}

}  // namespace pellucid::inline v0_1
