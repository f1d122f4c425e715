// SPDX-License-Identifier: MIT
/// \file
/// Meshes of simple shapes: closed, outward, on their surface.
#include <pellucid/scene/primitives.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include "support/catch.hpp"

using namespace pellucid;

namespace {

/// Six times the signed volume: positive where triangles are counter-clockwise from outside.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[t]]), b(mesh.positions[mesh.indices[t + 1]]),
            c(mesh.positions[mesh.indices[t + 2]]);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6;
}

/// Every edge is passed once in each direction.
bool closed(const Mesh& mesh) {
    using Point = std::tuple<float, float, float>;
    const auto point = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i] + 0.0f;
        return Point(p.x, p.y, p.z);
    };
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        ++edges[{point(mesh.indices[i]), point(mesh.indices[next])}];
    }
    for (const auto& [edge, count] : edges)
        if (count != 1 || edges.count({edge.second, edge.first}) == 0) return false;
    return true;
}

void check_valid(const Mesh& mesh) {
    CHECK(mesh.normals.size() == mesh.positions.size());
    std::vector<bool> used(mesh.positions.size());
    for (const std::uint32_t i : mesh.indices) {
        REQUIRE(i < mesh.positions.size());
        used[i] = true;
    }
    CHECK(std::count(used.begin(), used.end(), false) == 0);
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                        c = mesh.positions[mesh.indices[t + 2]];
        REQUIRE(glm::dot(glm::cross(b - a, c - a), mesh.normals[mesh.indices[t]]) > 0);
    }
}

}  // namespace

TEST_CASE("spheres are closed, outward and round", "[cpu][primitives]") {
    constexpr double exact = 4.0 / 3.0 * 3.14159265358979 * 8;
    for (const Mesh& mesh :
         {make_uv_sphere(2, 48, 96), make_icosphere(2, 4), make_uv_sphere(2, 2, 3), make_icosphere(2, 0)}) {
        check_valid(mesh);
        CHECK(closed(mesh));
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            REQUIRE(glm::length(mesh.positions[v]) == Approx(2));
            REQUIRE(glm::length(mesh.normals[v]) == Approx(1));
        }
    }
    CHECK(volume(make_uv_sphere(2, 48, 96)) == Approx(exact).epsilon(0.005));
    CHECK(volume(make_icosphere(2, 4)) == Approx(exact).epsilon(0.005));
    CHECK(make_uv_sphere(1, 8, 16).indices.size() / 3 == 2 * 16 * 7);
    CHECK(make_icosphere(1, 3).indices.size() / 3 == 20 * 64);
    CHECK(make_icosphere(1, 3).positions.size() == 10 * 64 + 2);
}

TEST_CASE("boxes and planes", "[cpu][primitives]") {
    const Mesh box = make_box({1, 2, 3});
    check_valid(box);
    CHECK(closed(box));
    CHECK(volume(box) == Approx(6));
    CHECK(box.upper == glm::vec3(0.5f, 1, 1.5f));
    const Mesh plane = make_plane(2, 4, 3);
    check_valid(plane);
    CHECK(plane.lower == glm::vec3(-1, 0, -2));
    CHECK(plane.uv0[2] == glm::vec2(3, 0));
}
