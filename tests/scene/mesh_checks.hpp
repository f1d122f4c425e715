// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What tests of meshes ask: is it valid, is it closed, how much does it hold.
#include <pellucid/scene/mesh.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include "support/catch.hpp"

namespace pellucid::test {

inline std::array<glm::dvec3, 3> triangle(const Mesh& mesh, std::size_t first_index) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec3(mesh.positions[mesh.indices[first_index + c]]);
    return corners;
}

/// Signed volume (divergence theorem): positive where triangles are counter-clockwise from outside.
inline double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto [a, b, c] = triangle(mesh, t);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6;
}

inline double area(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto [a, b, c] = triangle(mesh, t);
        sum += glm::length(glm::cross(b - a, c - a));
    }
    return sum / 2;
}

using Point = std::tuple<float, float, float>;
/// A position as a key; -0 is 0.
inline Point point_of(const Mesh& mesh, std::uint32_t index) {
    const glm::vec3 p = mesh.positions[index] + 0.0f;
    return {p.x, p.y, p.z};
}

/// The directed edges (by position) that no triangle passes the other way, or that are passed twice: none in a closed
/// surface.
inline std::vector<std::pair<Point, Point>> open_edges(const Mesh& mesh) {
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        ++edges[{point_of(mesh, mesh.indices[i]), point_of(mesh, mesh.indices[next])}];
    }
    std::vector<std::pair<Point, Point>> open;
    for (const auto& [edge, count] : edges)
        if (count != 1 || edges.count({edge.second, edge.first}) == 0) open.push_back(edge);
    return open;
}

/// Every edge is passed once in each direction.
inline bool closed(const Mesh& mesh) {
    return open_edges(mesh).empty();
}

/// Every mesh's own rules, and: every vertex is used, normals are unit, no triangle is degenerate and, where the mesh
/// is `fine` enough for its curvature, normals are on the triangle's front side at each corner.
inline void check_valid(const Mesh& mesh, bool fine = true) {
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    CHECK((mesh.uv0.empty() || mesh.uv0.size() == mesh.positions.size()));
    CHECK((mesh.colors.empty() || mesh.colors.size() == mesh.positions.size()));
    REQUIRE(mesh.indices.size() % 3 == 0);
    std::vector<bool> used(mesh.positions.size());
    for (const std::uint32_t i : mesh.indices) {
        REQUIRE(i < mesh.positions.size());
        used[i] = true;
    }
    CHECK(std::count(used.begin(), used.end(), false) == 0);
    double shortest = 1, longest = 1;
    glm::vec3 lower = mesh.positions[0], upper = lower;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        for (int c = 0; c < 3; ++c) REQUIRE(std::isfinite(mesh.positions[v][c]));
        lower = glm::min(lower, mesh.positions[v]);
        upper = glm::max(upper, mesh.positions[v]);
        const double length = glm::length(glm::dvec3(mesh.normals[v]));
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
    }
    CHECK(std::max(longest - 1, 1 - shortest) < 2e-7);
    CHECK((mesh.lower == lower && mesh.upper == upper));
    int degenerate = 0, behind = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto [a, b, c] = triangle(mesh, t);
        const glm::dvec3 facing = glm::cross(b - a, c - a);
        degenerate += glm::length(facing) > 0 ? 0 : 1;
        for (std::size_t corner = 0; corner < 3; ++corner)
            behind += glm::dot(facing, glm::dvec3(mesh.normals[mesh.indices[t + corner]])) > 0 ? 0 : 1;
    }
    CHECK(degenerate == 0);
    if (fine) CHECK(behind == 0);
}

}  // namespace pellucid::test
