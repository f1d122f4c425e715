// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Whether a mesh can be proved to be a sheet or a shell, as sort_conflicts.hpp has it.  Object space, in double.
#include <pellucid/scene/mesh.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

namespace pellucid::inline v0_1::detail {

/// The plane of a triangle.
struct FacePlane {
    glm::dvec3 normal{0, 0, 0};  ///< as long as twice the triangle's area
    glm::dvec3 point{0, 0, 0};
};

struct MeshShape {
    enum class Kind : std::uint8_t { unknown, sheet, shell } kind = Kind::unknown;
    bool flat = false;                                                   ///< sheet: one plane
    std::vector<FacePlane> faces;                                        ///< sheet: all; shell: those beside valleys
    std::vector<std::array<std::uint32_t, 2>> valleys;                   ///< shell: the faces of each
    glm::dvec3 lower{0, 0, 0}, upper{0, 0, 0};                           ///< of the triangles' corners
    static constexpr std::size_t most_triangles = std::size_t{1} << 20;  ///< larger meshes are not looked at
};

/// Where the view rays come from, in object space: a point, or a direction at infinity (w = 0).
struct Eye {
    glm::dvec3 at{0, 0, 0};
    double w = 1;
};

/// 1: the face turns its front to the eye; -1: its back; 0: edge-on as far as rounding tells.
[[nodiscard]] inline int facing(const FacePlane& face, const Eye& eye) noexcept {
    const double height = glm::dot(face.normal, eye.at - eye.w * face.point);
    const double doubt = 1e-9 * glm::length(face.normal) * (glm::length(eye.at) + eye.w * glm::length(face.point));
    return height > doubt ? 1 : height < -doubt ? -1 : 0;
}

/// A triangle whose corners are numbers of welded positions.
using Corners = std::array<std::uint32_t, 3>;

/// An edge of a triangle in the triangle's direction.
struct DirectedEdge {
    std::uint32_t from = 0, to = 0, triangle = 0;
    [[nodiscard]] std::tuple<std::uint32_t, std::uint32_t> line() const noexcept {
        return {std::min(from, to), std::max(from, to)};
    }
};

/// The mesh with equal positions made one, without triangles that have two equal corners.
struct WeldedMesh {
    std::vector<glm::dvec3> points;
    std::vector<Corners> triangles;
    std::vector<DirectedEdge> edges;  ///< those of one line beside each other

    [[nodiscard]] FacePlane plane(std::uint32_t triangle) const {
        const auto [a, b, c] = triangles[triangle];
        return {glm::cross(points[b] - points[a], points[c] - points[a]), points[a]};
    }
};

[[nodiscard]] inline WeldedMesh welded(const Mesh& mesh) {
    const auto key = [&](std::uint32_t i) {
        const glm::vec3& p = mesh.positions[i];
        return std::tuple(p.x, p.y, p.z);
    };
    std::vector<std::uint32_t> order(mesh.positions.size()), id(mesh.positions.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    WeldedMesh out;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) out.points.push_back(glm::dvec3(mesh.positions[order[i]]));
        id[order[i]] = static_cast<std::uint32_t>(out.points.size() - 1);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Corners t{id[mesh.indices[i]], id[mesh.indices[i + 1]], id[mesh.indices[i + 2]]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        const auto triangle = static_cast<std::uint32_t>(out.triangles.size());
        for (std::size_t e = 0; e < 3; ++e) out.edges.push_back({t[e], t[(e + 1) % 3], triangle});
        out.triangles.push_back(t);
    }
    std::sort(out.edges.begin(), out.edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return std::tuple(a.line(), a.from, a.triangle) < std::tuple(b.line(), b.from, b.triangle);
    });
    return out;
}

/// Calls `visit(first, last)` for the edges of each line; stops and gives false where it says false.
template <class F>
[[nodiscard]] bool each_line(const WeldedMesh& mesh, F&& visit) {
    for (std::size_t first = 0, last; first < mesh.edges.size(); first = last) {
        for (last = first; last < mesh.edges.size() && mesh.edges[last].line() == mesh.edges[first].line();) ++last;
        if (!visit(first, last)) return false;
    }
    return true;
}

/// Whether directed edges are one polygon that, seen along the unit vector `axis`, turns left at every corner, once
/// round.
[[nodiscard]] inline bool one_convex_loop(const WeldedMesh& mesh, std::vector<DirectedEdge> boundary,
                                          const glm::dvec3& axis) {
    if (boundary.size() < 3) return false;
    std::sort(boundary.begin(), boundary.end(),
              [](const DirectedEdge& a, const DirectedEdge& b) { return a.from < b.from; });
    for (std::size_t i = 1; i < boundary.size(); ++i)
        if (boundary[i].from == boundary[i - 1].from) return false;
    const auto after = [&](const DirectedEdge& edge) {
        const auto at = std::lower_bound(boundary.begin(), boundary.end(), edge.to,
                                         [](const DirectedEdge& e, std::uint32_t v) { return e.from < v; });
        return at != boundary.end() && at->from == edge.to ? &*at : nullptr;
    };
    const auto along = [&](const DirectedEdge& edge) {
        const glm::dvec3 d = mesh.points[edge.to] - mesh.points[edge.from];
        return d - axis * glm::dot(axis, d);
    };
    const DirectedEdge* edge = &boundary.front();
    double turned = 0;
    for (std::size_t i = 0; i < boundary.size(); ++i) {
        const DirectedEdge* next = after(*edge);
        if (!next || (next == &boundary.front()) != (i + 1 == boundary.size())) return false;
        const glm::dvec3 a = along(*edge), b = along(*next);
        const double turn = std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
        if (!(turn > -1e-6)) return false;  // a straight side of many edges bends a little by rounding
        turned += turn;
        edge = next;
    }
    return std::abs(turned - 2 * std::numbers::pi) < 0.1;
}

[[nodiscard]] inline MeshShape sheet_shape(const WeldedMesh& mesh, const std::vector<DirectedEdge>& boundary) {
    MeshShape shape;
    glm::dvec3 sum(0);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        shape.faces.push_back(mesh.plane(t));
        sum += shape.faces.back().normal;
    }
    const double length = glm::length(sum);
    if (!(length > 0)) return {};
    const glm::dvec3 axis = sum / length;
    for (const FacePlane& face : shape.faces)
        if (!(glm::dot(face.normal, axis) > 1e-6 * glm::length(face.normal))) return {};
    if (!one_convex_loop(mesh, boundary, axis)) return {};
    shape.kind = MeshShape::Kind::sheet;
    double thickness = 0, extent = 0;
    for (const Corners& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            thickness = std::max(thickness, std::abs(glm::dot(axis, mesh.points[v] - shape.faces[0].point)));
            extent = std::max(extent, glm::length(mesh.points[v]));
        }
    shape.flat = thickness <= 1e-13 * extent;
    return shape;
}

/// The solid angle of a triangle seen from the origin [sr]: A. Van Oosterom and J. Strackee, "The Solid Angle of a
/// Plane Triangle", 1983.  0 or less where it does not face away.
[[nodiscard]] inline double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double volume = glm::dot(a, glm::cross(b, c));
    if (!(volume > 1e-12 * la * lb * lc)) return 0;
    return 2 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

[[nodiscard]] inline MeshShape shell_shape(const WeldedMesh& mesh) {
    glm::dvec3 center(0);
    for (const Corners& t : mesh.triangles) center += mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]];
    center /= 3.0 * static_cast<double>(mesh.triangles.size());
    double sphere = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const double angle = solid_angle(mesh.points[a] - center, mesh.points[b] - center, mesh.points[c] - center);
        if (!(angle > 0)) return {};
        sphere += angle;
    }
    if (!(std::abs(sphere - 4 * std::numbers::pi) < 0.1)) return {};
    MeshShape shape;
    const bool closed = each_line(mesh, [&](std::size_t first, std::size_t last) {
        if (last - first != 2) return false;  // and opposite: no edge is left over
        const DirectedEdge &edge = mesh.edges[first], &other = mesh.edges[first + 1];
        const Corners& t = mesh.triangles[other.triangle];
        const FacePlane plane = mesh.plane(edge.triangle);
        for (const std::uint32_t v : t) {
            if (v == edge.from || v == edge.to) continue;
            const glm::dvec3 across = mesh.points[v] - plane.point;
            if (glm::dot(plane.normal, across) <= 1e-12 * glm::length(plane.normal) * glm::length(across)) continue;
            const auto n = static_cast<std::uint32_t>(shape.faces.size());
            shape.faces.push_back(plane);
            shape.faces.push_back(mesh.plane(other.triangle));
            shape.valleys.push_back({n, n + 1});
        }
        return true;
    });
    if (!closed) return {};
    shape.kind = MeshShape::Kind::shell;
    return shape;
}

/// What can be proved of a mesh, whatever it is seen from.
[[nodiscard]] inline MeshShape mesh_shape(const Mesh& mesh) {
    if (mesh.indices.size() / 3 > MeshShape::most_triangles) return {};
    const WeldedMesh made = welded(mesh);
    if (made.triangles.empty()) return {};
    std::vector<DirectedEdge> boundary;
    const bool regular = each_line(made, [&](std::size_t first, std::size_t last) {
        std::ptrdiff_t net = 0;
        for (std::size_t i = first; i < last; ++i) net += made.edges[i].from < made.edges[i].to ? 1 : -1;
        if (net > 1 || net < -1) return false;
        const auto [low, high] = made.edges[first].line();
        if (net == 1) boundary.push_back({low, high, 0});
        if (net == -1) boundary.push_back({high, low, 0});
        return true;
    });
    if (!regular) return {};
    MeshShape shape = boundary.empty() ? shell_shape(made) : sheet_shape(made, boundary);
    shape.lower = shape.upper = made.points[made.triangles[0][0]];
    for (const Corners& t : made.triangles)
        for (const std::uint32_t v : t) {
            shape.lower = glm::min(shape.lower, made.points[v]);
            shape.upper = glm::max(shape.upper, made.points[v]);
        }
    return shape;
}

/// Whether no ray from the eye can meet the same side of the shape twice, nor its front side behind its back side.
/// `eye`: null where the instance has no object space of its own (its matrix cannot be inverted).
[[nodiscard]] inline bool proved_in_order(const MeshShape& shape, const Eye* eye) noexcept {
    if (shape.kind == MeshShape::Kind::sheet) {
        if (shape.flat) return true;
        if (!eye) return false;
        const int side = facing(shape.faces[0], *eye);
        return side != 0 && std::all_of(shape.faces.begin(), shape.faces.end(),
                                        [&](const FacePlane& face) { return facing(face, *eye) == side; });
    }
    if (shape.kind != MeshShape::Kind::shell || !eye) return false;
    if (shape.valleys.empty()) return true;
    const bool outside = eye->w == 0 || glm::any(glm::lessThan(eye->at, shape.lower)) ||
                         glm::any(glm::greaterThan(eye->at, shape.upper));
    return outside && std::all_of(shape.valleys.begin(), shape.valleys.end(), [&](const auto& valley) {
               const int side = facing(shape.faces[valley[0]], *eye);
               return side != 0 && facing(shape.faces[valley[1]], *eye) == side;
           });
}

}  // namespace pellucid::inline v0_1::detail
