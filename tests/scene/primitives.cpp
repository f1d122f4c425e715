// SPDX-License-Identifier: MIT
/// \file
/// Meshes of simple shapes: closed, outward, on their surface.
#include <pellucid/scene/primitives.hpp>
#include <glm/geometric.hpp>
#include <cmath>
#include "scene/mesh_checks.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

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

TEST_CASE("tori are closed, outward and as big as a torus", "[cpu][primitives]") {
    constexpr double pi = 3.14159265358979323846, major = 1.5, minor = 0.5;
    for (const auto& [segments, sides] : {std::pair(3u, 3u), std::pair(5u, 8u), std::pair(64u, 24u)}) {
        INFO(segments << " x " << sides);
        const Mesh mesh = make_torus(1.5f, 0.5f, segments, sides);
        check_valid(mesh);
        CHECK(closed(mesh));
        CHECK(mesh.indices.size() / 3 == 2 * segments * sides);
        // Each segment is a slice of a prism between two half planes: Pappus with the chord's factor.
        const double section = 0.5 * sides * minor * minor * std::sin(2 * pi / sides);
        CHECK(volume(mesh) == Approx(segments * std::sin(2 * pi / segments) * major * section).epsilon(1e-6));
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 p(mesh.positions[v]);
            const glm::dvec3 center = major * glm::normalize(glm::dvec3(p.x, 0, p.z));
            REQUIRE(glm::length(p - center) == Approx(minor).epsilon(1e-6));
            REQUIRE(glm::length((p - center) / minor - glm::dvec3(mesh.normals[v])) < 1e-6);
        }
    }
    // The limits, and the order of the error: four times as near with half the step.
    const double exact_volume = 2 * pi * pi * major * minor * minor, exact_area = 4 * pi * pi * major * minor;
    double volume_error[2], area_error[2];
    for (const std::uint32_t i : {0u, 1u}) {
        const Mesh mesh = make_torus(1.5f, 0.5f, 64 << i, 32 << i);
        volume_error[i] = exact_volume - volume(mesh);
        area_error[i] = exact_area - area(mesh);
    }
    CHECK(volume_error[1] / exact_volume < 0.003);
    CHECK(volume_error[0] / volume_error[1] == Approx(4).epsilon(0.02));
    CHECK(area_error[0] / area_error[1] == Approx(4).epsilon(0.02));
}

TEST_CASE("the picture on a torus is upright from outside and seamless", "[cpu][primitives]") {
    const Mesh mesh = make_torus(2, 1, 12, 8);
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::dvec2 a(mesh.uv0[mesh.indices[t]]), b(mesh.uv0[mesh.indices[t + 1]]),
            c(mesh.uv0[mesh.indices[t + 2]]);
        // u to the right and v down, as seen from outside: counter-clockwise triangles are clockwise in (u, v).
        REQUIRE((b - a).x * (c - a).y - (b - a).y * (c - a).x == Approx(-1.0 / (12 * 8)));
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 p = mesh.positions[v];
        // u from -x over +z to +x; v from the inner side over the top to the outer side.
        if (std::abs(mesh.uv0[v].x - 0.25f) < 1e-3f) CHECK((std::abs(p.x) < 1e-6f && p.z > 0));
        if (mesh.uv0[v].y == 0.0f) CHECK(glm::length(glm::vec2(p.x, p.z)) == Approx(1));
        if (mesh.uv0[v].y == 0.25f) CHECK(p.y == Approx(1));
        if (mesh.uv0[v].y == 0.5f) CHECK(glm::length(glm::vec2(p.x, p.z)) == Approx(3));
    }
}
