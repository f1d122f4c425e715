// SPDX-License-Identifier: MIT
/// \file
/// Cube maps: the table of faces, edges, solid angles, and chains that neither lose nor move light.
#include <pellucid/reference/cube_map.hpp>
#include <cstdio>
#include <limits>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::Random;

namespace {
constexpr double pi = std::numbers::pi;
bool near(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-14) {
    return glm::length(a - b) <= tolerance;
}
}  // namespace

TEST_CASE("faces are those of the specifications' table", "[cpu]") {
    // Major axis, the way u grows, the way v grows: rows of the table in both specifications.
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const struct {
        glm::dvec3 major, s, t;
    } table[6] = {{x, -z, -y}, {-x, z, -y}, {y, x, z}, {-y, x, -z}, {z, x, -y}, {-z, -x, -y}};
    for (std::uint32_t face = 0; face < 6; ++face) {
        INFO("face " << face);
        const auto& row = table[face];
        CHECK(near(cube_direction(face, {0.5, 0.5}), row.major));
        CHECK(near(cube_direction(face, {0.75, 0.5}), glm::normalize(row.major + 0.5 * row.s)));
        CHECK(near(cube_direction(face, {0.5, 0.75}), glm::normalize(row.major + 0.5 * row.t)));
        CHECK(near(cube_direction(face, {1, 0}), glm::normalize(row.major + row.s - row.t)));
        const CubePlace place = cube_place(3.0 * row.major + 1.5 * row.s - 0.75 * row.t);
        CHECK(place.face == face);
        CHECK(place.uv.x == Approx(0.75).epsilon(1e-15));
        CHECK(place.uv.y == Approx(0.375).epsilon(1e-15));
    }
}

TEST_CASE("places and directions are inverse, on edges and corners too", "[cpu]") {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 d = random.direction();
        const CubePlace place = cube_place(d);
        CHECK(near(cube_direction(place.face, place.uv), d));
        CHECK((place.uv.x >= 0 && place.uv.x <= 1 && place.uv.y >= 0 && place.uv.y <= 1));
    }
    for (std::uint32_t face = 0; face < 6; ++face)
        for (int i = 0; i <= 8; ++i)
            for (const double edge : {0.0, 1.0})
                for (const glm::dvec2 uv : {glm::dvec2(edge, i / 8.0), glm::dvec2(i / 8.0, edge)}) {
                    // Whichever face an edge is given to, it is the same direction.
                    const glm::dvec3 d = cube_direction(face, uv);
                    const CubePlace place = cube_place(d);
                    CHECK(near(cube_direction(place.face, place.uv), d));
                }
}

TEST_CASE("solid angles of texels add up to the sphere", "[cpu]") {
    CHECK(cube_solid_angle({0, 0}, {1, 1}) == Approx(2 * pi / 3).epsilon(1e-14));
    for (const int n : {1, 2, 7, 64}) {
        double sum = 0;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                sum += cube_solid_angle(glm::dvec2(x, y) / double(n), glm::dvec2(x + 1, y + 1) / double(n));
        CHECK(6 * sum == Approx(4 * pi).epsilon(1e-11));
    }
    // A small one is area/distance² cos: at the middle of a face (2/n)², at a corner that over 3√3.
    const double step = 1e-4;
    CHECK(cube_solid_angle({0.5, 0.5}, glm::dvec2(0.5 + step)) / (4 * step * step) == Approx(1).epsilon(1e-3));
    CHECK(cube_solid_angle(glm::dvec2(1 - step), {1, 1}) / (4 * step * step) ==
          Approx(std::pow(3, -1.5)).epsilon(1e-3));
}

TEST_CASE("lookups are seamless", "[cpu]") {
    // Radiance = direction: what a lookup returns is nearly the direction it was asked for, on edges and corners too.
    const auto itself = [](glm::dvec3 d) { return d; };
    for (const std::uint32_t size : {16u, 64u}) {
        const CubeChain cube = make_cube_chain(itself, size);
        const double texel = 2.0 / size;
        double worst = 0, jump = 0;
        Random random(2);
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 d = random.direction();
            worst = std::max(worst, glm::length(sample_cube(cube, d) - d));
        }
        for (std::uint32_t face = 0; face < 6; ++face)
            for (int i = 0; i <= 64; ++i)
                for (const double edge : {0.0, 1.0})
                    for (const bool swap : {false, true}) {
                        const auto at = [&](double inset) {
                            const double u = edge + (edge > 0 ? -inset : inset);
                            const glm::dvec2 uv = swap ? glm::dvec2(i / 64.0, u) : glm::dvec2(u, i / 64.0);
                            return sample_cube(cube, cube_direction(face, uv));
                        };
                        jump = std::max(jump, glm::length(at(1e-7) - at(-1e-7)));
                        worst = std::max(worst,
                                         glm::length(at(0) - cube_direction(face, swap ? glm::dvec2(i / 64.0, edge)
                                                                                       : glm::dvec2(edge, i / 64.0))));
                    }
        INFO("size " << size << ": error " << worst / texel << " texels, jump " << jump / texel);
        CHECK(jump < 1e-5);
        CHECK(worst < 0.35 * texel);
    }
}

TEST_CASE("every level of a constant is that constant, between levels and beyond them", "[cpu]") {
    for (const CubeFilter filter : {CubeFilter::box, CubeFilter::tent}) {
        const CubeChain cube = make_cube_chain([](glm::dvec3) { return glm::dvec3(0.5, 1, 2); }, 16, filter);
        REQUIRE(cube.levels.size() == 5);
        CHECK(cube.levels[4][5].width == 1);
        CHECK(cube.texels() == 6 * 256);
        Random random(3);
        for (const double lod : {-1.0, 0.0, 0.5, 3.75, 4.0, 99.0})
            CHECK(near(sample_cube(cube, random.direction(), lod), {0.5, 1, 2}, 1e-6));
        CHECK(near(prefiltered_radiance(cube, 1, random.direction(), 0.3), {0.5, 1, 2}, 1e-6));
    }
}

TEST_CASE("the level to sum over: 64 texels a side, or as many as a narrow lobe needs", "[cpu]") {
    const CubeChain cube{256, std::vector<std::array<ImageF, 6>>(9)}, small{32, std::vector<std::array<ImageF, 6>>(6)};
    CHECK(prefilter_level(cube, 1.0) == 2);
    CHECK(prefilter_level(cube, 0.0625) == 2);
    CHECK(prefilter_level(cube, 0.06) == 1);
    CHECK(prefilter_level(cube, 0.01) == 0);
    CHECK(prefilter_level(cube, 0.0) == 0);
    CHECK(prefilter_level(small, 1.0) == 0);
}

TEST_CASE("the tent filter keeps the middle of what it spreads, the box does not", "[cpu]") {
    // One bright texel in the middle of a face: its centre of gravity on the face, level by level.
    const auto centre = [](CubeFilter filter, std::size_t level) {
        const glm::dvec3 sun = cube_direction(4, {(37 + 0.5) / 64, (26 + 0.5) / 64});
        const CubeChain cube = make_cube_chain(
            [&](glm::dvec3 d) {
                const CubePlace a = cube_place(d), b = cube_place(sun);
                return glm::dvec3(a.face == b.face && glm::length(a.uv - b.uv) < 0.4 / 64 ? 1000 : 0);
            },
            64, filter, 1);
        double sum = 0, total = 0;
        glm::dvec2 moment(0.0);
        const std::uint32_t side = 64u >> level;
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const double value = cube.levels[level][4].texel(x, y)[0];
                sum += value;
                moment += value * (glm::dvec2(x, y) + 0.5) / double(side);
            }
        for (const ImageF& face : cube.levels[level])
            for (const float value : face.data) total += value;
        CHECK(total / 3 * double(1u << (2 * level)) == Approx(1000).epsilon(1e-6));
        return moment / sum * 64.0;
    };
    for (const std::size_t level : {0u, 1u, 2u, 3u}) {
        const glm::dvec2 tent = centre(CubeFilter::tent, level);
        CHECK(tent.x == Approx(37.5).epsilon(1e-6));
        CHECK(tent.y == Approx(26.5).epsilon(1e-6));
    }
    CHECK(centre(CubeFilter::box, 3).x == Approx(36));
    CHECK(centre(CubeFilter::box, 3).y == Approx(28));
}

TEST_CASE("a sum over texels converges to the integral, the tent's quicker", "[cpu]") {
    // A sky with a sun of 1e4 in 1e-3 sr or so, against the same integral by Gauss rules.
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.5, -0.3));
    const auto radiance = [&](glm::dvec3 d) {
        const double gap = 1 - glm::dot(d, sun);
        return glm::dvec3(1 + d.y, 1, 0.5) + 1e4 * std::exp(-gap / 1.5e-4);
    };
    const CubeChain tent = make_cube_chain(radiance, 128, CubeFilter::tent, 4);
    const CubeChain box = make_cube_chain(radiance, 128, CubeFilter::box, 4);
    const double sun_light = 2 * pi * 1e4 * 1.5e-4;  // ∫ over the sphere, but for e^-13000
    Random random(4);
    double worst_tent[4] = {}, worst_box[4] = {};
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 axis = random.direction_above(sun);
        const double alpha = 0.25;
        const glm::dvec3 smooth =
            prefiltered_radiance([](glm::dvec3 d) { return glm::dvec3(1 + d.y, 1, 0.5); }, axis, alpha);
        const double lobe = prefilter_weight(1 - glm::dot(axis, sun), alpha) / prefilter_total(alpha);
        const glm::dvec3 exact = smooth + sun_light * lobe;
        for (std::size_t level = 0; level < 4; ++level) {
            const auto error = [&](const CubeChain& cube) {
                return std::abs(prefiltered_radiance(cube, level, axis, alpha).x / exact.x - 1);
            };
            worst_tent[level] = std::max(worst_tent[level], error(tent));
            worst_box[level] = std::max(worst_box[level], error(box));
        }
    }
    for (std::size_t level = 0; level < 4; ++level)
        std::printf("alpha 0.25, %3u texels a side: error of the sum %.4f %% (tent), %.4f %% (box)\n", 128u >> level,
                    worst_tent[level] * 100, worst_box[level] * 100);
    CHECK(worst_tent[0] < 0.004);
    CHECK(worst_tent[1] < 0.006);
    CHECK(worst_tent[2] < 0.02);
    CHECK(worst_box[2] > 1.5 * worst_tent[2]);
}
