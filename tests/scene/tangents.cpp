// SPDX-License-Identifier: MIT
/// \file
/// Tangents: directions, handedness, splitting, degenerate input; and what artists' tools made of a real model.
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cmath>
#include <random>
#include "support/assets.hpp"
#include "support/catch.hpp"

using namespace pellucid;

namespace {

void check_frames(const Mesh& mesh) {
    REQUIRE(mesh.tangents.size() == mesh.positions.size());
    for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
        const glm::vec3 t(mesh.tangents[v]);
        REQUIRE(std::abs(glm::length(t) - 1.0f) < 1e-5f);
        REQUIRE(std::abs(glm::dot(t, mesh.normals[v])) < 1e-5f);
        REQUIRE(std::abs(mesh.tangents[v].w) == 1.0f);
    }
}

/// Two triangles in the plane z = 0 seen from +z, `uv` at the corners (0,0), (1,0), (1,1), (0,1).
Mesh quad(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uv0 = {a, b, c, d};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

}  // namespace

TEST_CASE("a picture the right way round has its tangent along u and w = 1", "[cpu][tangents]") {
    Mesh mesh = quad({0, 1}, {1, 1}, {1, 0}, {0, 0});  // v runs down
    make_tangents(mesh);
    REQUIRE(mesh.positions.size() == 4);
    for (const glm::vec4& t : mesh.tangents) CHECK(t == glm::vec4(1, 0, 0, 1));
    // cross(n, t) w = +y: up the picture.
    Mesh mirrored = quad({1, 1}, {0, 1}, {0, 0}, {1, 0});
    make_tangents(mirrored);
    for (const glm::vec4& t : mirrored.tangents) CHECK(t == glm::vec4(-1, 0, 0, -1));
}

TEST_CASE("a seam of handedness splits vertices, other vertices stay", "[cpu][tangents]") {
    // Mirrored at the diagonal: both triangles have the same u, v at its ends.
    Mesh mesh = quad({0, 1}, {1, 1}, {1, 0}, {1, 1});
    make_tangents(mesh);
    check_frames(mesh);
    CHECK(mesh.positions.size() == 6);
    CHECK(mesh.indices.size() == 6);
    for (const std::size_t t : {std::size_t{0}, std::size_t{3}})
        for (std::size_t c = 1; c < 3; ++c)
            CHECK(mesh.tangents[mesh.indices[t + c]].w == mesh.tangents[mesh.indices[t]].w);
    CHECK(mesh.tangents[mesh.indices[0]].w == -mesh.tangents[mesh.indices[3]].w);
    CHECK(mesh.uv0.size() == 6);
}

TEST_CASE("the result does not depend on how corners are indexed", "[cpu][tangents]") {
    Mesh shared = make_uv_sphere(1, 12, 24);
    Mesh apart;
    for (const std::uint32_t i : shared.indices) {
        apart.indices.push_back(static_cast<std::uint32_t>(apart.positions.size()));
        apart.positions.push_back(shared.positions[i]);
        apart.normals.push_back(shared.normals[i]);
        apart.uv0.push_back(shared.uv0[i]);
    }
    make_tangents(shared);
    make_tangents(apart);
    check_frames(shared);
    for (std::size_t c = 0; c < shared.indices.size(); ++c) {
        const glm::vec4 a = shared.tangents[shared.indices[c]], b = apart.tangents[apart.indices[c]];
        REQUIRE(glm::length(a - b) < 1e-5f);
    }
}

TEST_CASE("on a sphere tangents follow the parallels", "[cpu][tangents]") {
    Mesh mesh = make_uv_sphere(1, 32, 64);
    const std::size_t before = mesh.positions.size();
    make_tangents(mesh);
    check_frames(mesh);
    CHECK(mesh.positions.size() == before);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 n = mesh.normals[v];
        CHECK(mesh.tangents[v].w == 1.0f);
        if (std::abs(n.y) > 0.95f) continue;
        const glm::vec3 along = glm::normalize(glm::vec3(n.z, 0, -n.x));  // growing u
        REQUIRE(glm::dot(glm::vec3(mesh.tangents[v]), along) > 0.998f);   // the seam's vertices see one side only
    }
}

TEST_CASE("degenerate texture coordinates, triangles and normals give finite frames", "[cpu][tangents]") {
    Mesh constant = quad({0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f});
    make_tangents(constant);
    check_frames(constant);
    Mesh line = quad({0, 0}, {1, 0}, {2, 0}, {3, 0});
    make_tangents(line);
    check_frames(line);
    Mesh point = quad({0, 1}, {1, 1}, {1, 0}, {0, 0});
    point.positions.assign(4, {1, 2, 3});
    make_tangents(point);
    check_frames(point);
    // The direction of u along the normal itself leaves nothing.
    Mesh upright = quad({0, 1}, {1, 1}, {1, 0}, {0, 0});
    upright.normals.assign(4, {1, 0, 0});
    make_tangents(upright);
    check_frames(upright);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1, 1);
    for (int round = 0; round < 50; ++round) {
        Mesh chaos;
        for (int i = 0; i < 20; ++i) {
            chaos.positions.push_back({number(random) * 1e18f, number(random), number(random) * 1e-18f});
            chaos.normals.push_back(glm::normalize(glm::vec3(number(random), number(random), number(random) + 2)));
            chaos.uv0.push_back({number(random) * 1e10f, number(random) * 1e-10f});
        }
        for (int i = 0; i < 90; ++i) chaos.indices.push_back(static_cast<std::uint32_t>(random() % 20));
        make_tangents(chaos);
        check_frames(chaos);
    }
}

TEST_CASE("a model's own tangents agree with derived ones", "[cpu][tangents]") {
    const auto assets = test::assets();
    if (!assets) return;
    const auto scene = load_gltf((*assets / "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb").string());
    REQUIRE(scene);
    REQUIRE(scene->meshes.size() == 1);
    const Mesh& given = scene->meshes[0];
    REQUIRE_FALSE(given.tangents.empty());
    Mesh derived = given;
    make_tangents(derived);
    check_frames(derived);
    std::size_t same_sign = 0;
    std::vector<double> degrees;
    for (std::size_t c = 0; c < given.indices.size(); ++c) {
        const glm::vec4 a = given.tangents[given.indices[c]], b = derived.tangents[derived.indices[c]];
        same_sign += a.w == b.w ? 1 : 0;
        const double cosine = std::clamp(glm::dot(glm::dvec3(a), glm::dvec3(b)), -1.0, 1.0);
        degrees.push_back(std::acos(cosine) * 57.29577951308232);
    }
    std::sort(degrees.begin(), degrees.end());
    std::printf(
        "tangents of NormalTangentMirrorTest: sign agrees on %zu of %zu corners, angle median %.4f, p99 %.4f, "
        "max %.4f degrees\n",
        same_sign, degrees.size(), degrees[degrees.size() / 2], degrees[degrees.size() * 99 / 100], degrees.back());
    CHECK(same_sign == degrees.size());
    CHECK(degrees[degrees.size() * 99 / 100] < 1.0);
}
