// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Triangles in a tree of boxes, for rays: which ones does a segment meet.
///
/// Whether a ray passes inside of an edge is the sign of a triple product, which two triangles that share the edge
/// compute with the same values and the opposite sign, so no ray slips between them (the idea of A. Kensler and P.
/// Shirley, "Optimizing ray-triangle intersection via automated search", 2006, and of Woop et al., "Watertight
/// ray/triangle intersection", 2013).
#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::reference::detail {

struct TreeTriangle {
    glm::dvec3 corners[3];
    std::uint32_t primitive = 0;  ///< in draw order
    std::uint32_t draw = 0;
};

/// Where a ray meets a triangle.
struct RayHit {
    double distance = 0;    ///< along the ray, in lengths of its direction
    glm::dvec3 weights{0};  ///< of the corners
    bool front = false;     ///< met on the side from which its corners run counter-clockwise
};

class TriangleTree {
public:
    TriangleTree() = default;
    explicit TriangleTree(std::vector<TreeTriangle> triangles) : triangles_(std::move(triangles)) {
        if (triangles_.empty()) return;
        nodes_.reserve(2 * triangles_.size());
        nodes_.emplace_back();
        build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
    }
    [[nodiscard]] bool empty() const noexcept { return triangles_.empty(); }

    /// Whether `accept(triangle, hit)` is true of any triangle that the ray meets at a distance in (nearest, farthest).
    template <class Accept>
    [[nodiscard]] bool any(const glm::dvec3& origin, const glm::dvec3& direction, double nearest, double farthest,
                           Accept&& accept) const {
        if (triangles_.empty()) return false;
        const glm::dvec3 inverse = 1.0 / direction;  // infinite along an axis that the ray does not move on
        std::uint32_t stack[64], depth = 0;
        stack[depth++] = 0;
        while (depth != 0) {
            const Node& node = nodes_[stack[--depth]];
            if (!node.met(origin, inverse, nearest, farthest)) continue;
            if (node.count == 0) {
                stack[depth++] = node.first;
                stack[depth++] = node.first + 1;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                RayHit hit;
                if (meets(triangles_[i], origin, direction, hit) && hit.distance > nearest && hit.distance < farthest &&
                    accept(triangles_[i], hit))
                    return true;
            }
        }
        return false;
    }

private:
    struct Node {
        glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
        std::uint32_t first = 0;  ///< of its triangles, or of its two children
        std::uint32_t count = 0;  ///< 0: it has children

        /// Slabs; a ray within a face of the box, where 0 · infinity is no number, meets it.
        [[nodiscard]] bool met(const glm::dvec3& origin, const glm::dvec3& inverse, double enter,
                               double leave) const noexcept {
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (lower[axis] - origin[axis]) * inverse[axis];
                const double b = (upper[axis] - origin[axis]) * inverse[axis];
                if (std::min(a, b) > enter) enter = std::min(a, b);
                if (std::max(a, b) < leave) leave = std::max(a, b);
            }
            return enter <= leave * (1 + 1e-12);
        }
    };

    static bool meets(const TreeTriangle& t, const glm::dvec3& origin, const glm::dvec3& direction,
                      RayHit& hit) noexcept {
        const glm::dvec3 a = t.corners[0] - origin, b = t.corners[1] - origin, c = t.corners[2] - origin;
        const double u = glm::dot(direction, glm::cross(c, b)), v = glm::dot(direction, glm::cross(a, c)),
                     w = glm::dot(direction, glm::cross(b, a));
        if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return false;
        const double sum = u + v + w;
        if (sum == 0) return false;  // seen edge-on
        hit.weights = glm::dvec3(u, v, w) / sum;
        hit.distance = glm::dot(hit.weights.x * a + hit.weights.y * b + hit.weights.z * c, direction) /
                       glm::dot(direction, direction);
        hit.front = sum > 0;
        return true;
    }

    /// Halves by the middle of the longest side of the centres' box, down to four triangles.
    void build(std::uint32_t at, std::uint32_t first, std::uint32_t count) {
        glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper(-lower);
        for (std::uint32_t i = first; i < first + count; ++i)
            for (const glm::dvec3& p : triangles_[i].corners) {
                nodes_[at].lower = glm::min(nodes_[at].lower, p);
                nodes_[at].upper = glm::max(nodes_[at].upper, p);
                lower = glm::min(lower, center(triangles_[i]));
                upper = glm::max(upper, center(triangles_[i]));
            }
        const glm::dvec3 size = upper - lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (count <= 4) {
            nodes_[at].first = first;
            nodes_[at].count = count;
            return;
        }
        const std::uint32_t half = count / 2;
        const auto begin = triangles_.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](const TreeTriangle& a, const TreeTriangle& b) {
            const double x = center(a)[axis], y = center(b)[axis];
            return x != y ? x < y : a.primitive < b.primitive;
        });
        const auto children = static_cast<std::uint32_t>(nodes_.size());
        nodes_[at].first = children;
        nodes_.resize(nodes_.size() + 2);
        build(children, first, half);
        build(children + 1, first + half, count - half);
    }
    [[nodiscard]] static glm::dvec3 center(const TreeTriangle& t) noexcept {
        return (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0;
    }

    std::vector<TreeTriangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace pellucid::inline v0_1::reference::detail
