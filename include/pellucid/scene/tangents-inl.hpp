// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of tangents.hpp.
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <unordered_map>

namespace pellucid::inline v0_1 {
namespace detail {

/// Corners are one vertex where these eight floats have the same bits (with -0 as 0).
struct CornerKey {
    std::uint32_t bits[8];
    friend bool operator==(const CornerKey&, const CornerKey&) = default;
};
struct HashCorner {
    std::size_t operator()(const CornerKey& key) const noexcept {
        std::uint64_t hash = 0xCBF29CE484222325u;
        for (const std::uint32_t word : key.bits) hash = (hash ^ word) * 0x9E3779B97F4A7C15u, hash ^= hash >> 29u;
        return static_cast<std::size_t>(hash);
    }
};

/// What a triangle says about its texture: the direction of u and the handedness, or nothing.
struct TriangleFrame {
    glm::dvec3 along_u{0, 0, 0};
    std::int8_t sign = 0;  ///< 0: degenerate
};

inline TriangleFrame triangle_frame(const Mesh& mesh, const std::vector<glm::vec2>& uv, const std::uint32_t* corner) {
    const glm::dvec3 p0(mesh.positions[corner[0]]);
    const glm::dvec3 e1 = glm::dvec3(mesh.positions[corner[1]]) - p0, e2 = glm::dvec3(mesh.positions[corner[2]]) - p0;
    const glm::dvec2 t0(uv[corner[0]]);
    const glm::dvec2 d1 = glm::dvec2(uv[corner[1]]) - t0, d2 = glm::dvec2(uv[corner[2]]) - t0;
    const double area = d1.x * d2.y - d1.y * d2.x;  // twice the signed area in texture space
    TriangleFrame frame;
    const glm::dvec3 u = (e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(u);
    const double surface = glm::length(glm::cross(e1, e2));
    if (!(std::abs(area) > 0) || !(length > 0) || !(surface > 0) || !std::isfinite(length)) return frame;
    frame.along_u = u / length;
    // v runs down the picture and a normal map's green points up it: the bitangent points to falling v, so that a
    // picture that is not mirrored (negative area) has w = 1.
    frame.sign = area < 0 ? 1 : -1;
    return frame;
}

/// Disjoint sets of corners.
class CornerSets {
public:
    explicit CornerSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);  // the root is the first corner: order does not depend on joins
    }

private:
    std::vector<std::uint32_t> parent_;
};

inline glm::dvec3 orthogonal_part(glm::dvec3 v, glm::dvec3 normal) {
    const glm::dvec3 part = v - normal * glm::dot(normal, v);
    const double length = glm::length(part);
    return length > 1e-20 ? part / length : glm::dvec3(0);
}

template <class T>
void append_copy(std::vector<T>& values, std::size_t from) {
    if (!values.empty()) values.push_back(T(values[from]));
}

}  // namespace detail

PELLUCID_INLINE glm::vec3 any_tangent(glm::vec3 normal) {
    // The axis that is least along the normal leaves the longest remainder.
    const glm::vec3 a = glm::vec3(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                            : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
    const glm::dvec3 tangent = detail::orthogonal_part(axis, glm::dvec3(normal));
    return tangent == glm::dvec3(0) ? glm::vec3(1, 0, 0) : glm::vec3(tangent);
}

PELLUCID_INLINE void make_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv) {
    const std::size_t corners = mesh.indices.size() / 3 * 3;
    std::vector<detail::TriangleFrame> frames(corners / 3);
    for (std::size_t t = 0; t < frames.size(); ++t) frames[t] = detail::triangle_frame(mesh, uv, &mesh.indices[3 * t]);

    // Equal corners get one number, whatever index they came from.
    std::vector<std::uint32_t> shared(mesh.positions.size());
    {
        std::unordered_map<detail::CornerKey, std::uint32_t, detail::HashCorner> seen;
        seen.reserve(shared.size());
        for (std::size_t v = 0; v < shared.size(); ++v) {
            const glm::vec3 p = mesh.positions[v], n = mesh.normals[v];
            const float values[8] = {p.x, p.y, p.z, n.x, n.y, n.z, uv[v].x, uv[v].y};
            detail::CornerKey key;
            for (int i = 0; i < 8; ++i) key.bits[i] = std::bit_cast<std::uint32_t>(values[i] + 0.0f);
            shared[v] = seen.try_emplace(key, static_cast<std::uint32_t>(v)).first->second;
        }
    }

    // Triangles of one handedness that share an edge share the tangents of both its ends.
    detail::CornerSets sets(corners);
    {
        struct Edge {
            std::uint64_t key;  // the ends' numbers, the smaller first
            std::uint32_t low, high;
            std::int8_t sign;
        };
        std::vector<Edge> edges;
        edges.reserve(corners);
        for (std::uint32_t c = 0; c < corners; ++c) {
            const std::int8_t sign = frames[c / 3].sign;
            if (sign == 0) continue;
            std::uint32_t a = c, b = c % 3 == 2 ? c - 2 : c + 1;
            if (shared[mesh.indices[a]] > shared[mesh.indices[b]]) std::swap(a, b);
            edges.push_back({std::uint64_t{shared[mesh.indices[a]]} << 32u | shared[mesh.indices[b]], a, b, sign});
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return a.key != b.key ? a.key < b.key : a.sign != b.sign ? a.sign < b.sign : a.low < b.low;
        });
        for (std::size_t i = 1; i < edges.size(); ++i) {
            if (edges[i].key != edges[i - 1].key || edges[i].sign != edges[i - 1].sign) continue;
            sets.join(edges[i].low, edges[i - 1].low);
            sets.join(edges[i].high, edges[i - 1].high);
        }
    }

    std::vector<glm::dvec3> sums(corners, glm::dvec3(0));
    for (std::uint32_t c = 0; c < corners; ++c) {
        const detail::TriangleFrame& frame = frames[c / 3];
        if (frame.sign == 0) continue;
        const std::uint32_t first = c / 3 * 3;
        const std::uint32_t here = mesh.indices[c];
        const glm::dvec3 normal(mesh.normals[here]), p(mesh.positions[here]);
        const glm::dvec3 to_next(glm::dvec3(mesh.positions[mesh.indices[first + (c + 1) % 3]]) - p);
        const glm::dvec3 to_last(glm::dvec3(mesh.positions[mesh.indices[first + (c + 2) % 3]]) - p);
        const glm::dvec3 a = detail::orthogonal_part(to_next, normal), b = detail::orthogonal_part(to_last, normal);
        const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        sums[sets.find(c)] += detail::orthogonal_part(frame.along_u, normal) * angle;
    }

    // Each index takes the tangent of the first corner that uses it; corners with another one get a copy of the vertex.
    constexpr std::uint32_t none = ~0u;
    const std::size_t before = mesh.positions.size();
    std::vector<std::uint32_t> group_of(before, none);
    std::unordered_map<std::uint64_t, std::uint32_t> copies;  // (index, group) -> copy
    mesh.tangents.assign(before, glm::vec4(0));
    const auto tangent_of = [&](std::uint32_t vertex, std::uint32_t group, std::int8_t sign) {
        const glm::dvec3 sum = detail::orthogonal_part(sums[group], glm::dvec3(mesh.normals[vertex]));
        const glm::vec3 t = sum == glm::dvec3(0) ? any_tangent(mesh.normals[vertex]) : glm::vec3(sum);
        return glm::vec4(t, sign < 0 ? -1.0f : 1.0f);
    };
    for (std::uint32_t c = 0; c < corners; ++c) {
        const std::int8_t sign = frames[c / 3].sign;
        if (sign == 0) continue;  // takes what the vertex has
        const std::uint32_t vertex = mesh.indices[c], group = sets.find(c);
        if (group_of[vertex] == none) {
            group_of[vertex] = group;
            mesh.tangents[vertex] = tangent_of(vertex, group, sign);
        }
        if (group_of[vertex] == group) continue;
        const auto [copy, fresh] =
            copies.try_emplace(std::uint64_t{vertex} << 32u | group, static_cast<std::uint32_t>(mesh.positions.size()));
        if (fresh) {
            detail::append_copy(mesh.positions, vertex);
            detail::append_copy(mesh.normals, vertex);
            detail::append_copy(mesh.uv0, vertex);
            detail::append_copy(mesh.uv1, vertex);
            detail::append_copy(mesh.colors, vertex);
            mesh.tangents.push_back(tangent_of(vertex, group, sign));
        }
        mesh.indices[c] = copy->second;
    }
    for (std::size_t v = 0; v < before; ++v)
        if (group_of[v] == none) mesh.tangents[v] = glm::vec4(any_tangent(mesh.normals[v]), 1.0f);
}

PELLUCID_INLINE void make_tangents(Mesh& mesh) {
    const std::vector<glm::vec2> uv = mesh.uv0;  // the mesh may grow while it is read
    make_tangents(mesh, uv);
}

}  // namespace pellucid::inline v0_1
