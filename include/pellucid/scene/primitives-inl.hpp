// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of primitives.hpp.
#include <pellucid/scene/primitives.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace pellucid::inline v0_1 {

PELLUCID_INLINE void update_bounds(Mesh& mesh) {
    mesh.lower = mesh.upper = mesh.positions.empty() ? glm::vec3(0) : mesh.positions[0];
    for (const glm::vec3& p : mesh.positions) {
        mesh.lower = glm::min(mesh.lower, p);
        mesh.upper = glm::max(mesh.upper, p);
    }
}

PELLUCID_INLINE Mesh make_uv_sphere(float radius, std::uint32_t rings, std::uint32_t segments) {
    assert(rings >= 2 && segments >= 3);
    constexpr double pi = 3.14159265358979323846;
    Mesh mesh;
    mesh.name = "sphere";
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        const double v = static_cast<double>(ring) / rings;
        // Poles and the seam exactly: sin(pi) is not 0 in floating point.
        const double y = ring == 0 ? 1.0 : ring == rings ? -1.0 : std::cos(pi * v);
        const double r = ring == 0 || ring == rings ? 0.0 : std::sin(pi * v);
        for (std::uint32_t segment = 0; segment < segments + (r == 0.0 ? 0 : 1); ++segment) {
            const double angle = 2.0 * pi * (segment % segments) / segments;
            // A pole's vertex belongs to one triangle: its u is that triangle's middle.
            const double u = (segment + (r == 0.0 ? 0.5 : 0.0)) / segments;
            const glm::vec3 normal(-r * std::cos(angle), y, r * std::sin(angle));
            mesh.normals.push_back(normal);
            mesh.positions.push_back(normal * radius);
            mesh.uv0.push_back(glm::vec2(u, v));
        }
    }
    const auto vertex = [&](std::uint32_t ring, std::uint32_t segment) {
        return ring == 0 ? segment : segments + (ring - 1) * (segments + 1) + segment;
    };
    for (std::uint32_t ring = 0; ring < rings; ++ring)
        for (std::uint32_t segment = 0; segment < segments; ++segment) {
            const std::uint32_t a = vertex(ring, segment), b = vertex(ring + 1, segment);
            if (ring > 0) mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            if (ring + 1 < rings) mesh.indices.insert(mesh.indices.end(), {ring > 0 ? a + 1 : a, b, b + 1});
        }
    update_bounds(mesh);
    return mesh;
}

PELLUCID_INLINE Mesh make_icosphere(float radius, std::uint32_t subdivisions) {
    assert(subdivisions <= 8);
    Mesh mesh;
    mesh.name = "icosphere";
    const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
    std::vector<glm::dvec3> points;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-golden, golden}) {
            points.push_back({0, s, t});
            points.push_back({s, t, 0});
            points.push_back({t, 0, s});
        }
    for (glm::dvec3& p : points) p = glm::normalize(p);
    // The faces are the triples of neighbours; neighbours are the nearest points.
    const double edge = 4.0 / (1.0 + golden * golden);  // squared length
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec3 d = points[a] - points[b];
        return glm::dot(d, d) < 1.01 * edge;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
                const bool outward = glm::dot(glm::cross(points[b] - points[a], points[c] - points[a]), points[a]) > 0;
                mesh.indices.insert(mesh.indices.end(), {a, outward ? b : c, outward ? c : b});
            }
    for (std::uint32_t step = 0; step < subdivisions; ++step) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (fresh) points.push_back(glm::normalize(points[a] + points[b]));
            return found->second;
        };
        std::vector<std::uint32_t> finer;
        finer.reserve(mesh.indices.size() * 4);
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            const std::uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        mesh.indices = std::move(finer);
    }
    for (const glm::dvec3& p : points) {
        mesh.normals.push_back(glm::vec3(p));
        mesh.positions.push_back(glm::vec3(p) * radius);
    }
    update_bounds(mesh);
    return mesh;
}

PELLUCID_INLINE Mesh make_torus(float major, float minor, std::uint32_t segments, std::uint32_t sides) {
    assert(segments >= 3 && sides >= 3 && minor > 0 && major > minor);
    constexpr double pi = 3.14159265358979323846;
    Mesh mesh;
    mesh.name = "torus";
    for (std::uint32_t segment = 0; segment <= segments; ++segment) {
        const double u = static_cast<double>(segment) / segments;
        const double around = 2.0 * pi * (segment % segments) / segments;  // the seam exactly
        const glm::dvec3 outward(-std::cos(around), 0, std::sin(around));
        for (std::uint32_t side = 0; side <= sides; ++side) {
            const double v = static_cast<double>(side) / sides;
            const double angle = 2.0 * pi * (side % sides) / sides;
            const glm::dvec3 normal = -std::cos(angle) * outward + glm::dvec3(0, std::sin(angle), 0);
            mesh.positions.push_back(glm::vec3(double{major} * outward + double{minor} * normal));
            mesh.normals.push_back(glm::vec3(normal));
            mesh.uv0.push_back(glm::vec2(u, v));
        }
    }
    for (std::uint32_t segment = 0; segment < segments; ++segment)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = segment * (sides + 1) + side, right = a + sides + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, right, right, a + 1, right + 1});
        }
    update_bounds(mesh);
    return mesh;
}

PELLUCID_INLINE Mesh make_box(glm::vec3 size) {
    Mesh mesh;
    mesh.name = "box";
    struct Face {
        glm::vec3 normal, right, up;
    };
    constexpr Face faces[] = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                              {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                              {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
    for (const Face& face : faces) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec2 corner : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
            const glm::vec3 p =
                face.normal + face.right * (2.0f * corner.x - 1.0f) + face.up * (1.0f - 2.0f * corner.y);
            mesh.positions.push_back(p * 0.5f * size);
            mesh.normals.push_back(face.normal);
            mesh.uv0.push_back(corner);
        }
        mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
    update_bounds(mesh);
    return mesh;
}

PELLUCID_INLINE Mesh make_plane(float size_x, float size_z, float tiles) {
    Mesh mesh;
    mesh.name = "plane";
    for (const glm::vec2 corner : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
        mesh.positions.push_back({(corner.x - 0.5f) * size_x, 0.0f, (corner.y - 0.5f) * size_z});
        mesh.normals.push_back({0, 1, 0});
        mesh.uv0.push_back(corner * tiles);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    update_bounds(mesh);
    return mesh;
}

}  // namespace pellucid::inline v0_1
