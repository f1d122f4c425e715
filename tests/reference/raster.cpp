// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <pellucid/reference/raster.hpp>
#include <vector>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::Random;

namespace {

/// A clip-space vertex that projects exactly on a sample; depth 0.5.
glm::dvec4 on(const SamplePoint& s, double scale = 1) {
    return {s.x * scale, s.y * scale, 0.5 * s.w * scale, s.w * scale};
}
/// A vertex at normalised device coordinates, with this w.
glm::dvec4 at(double x, double y, double w = 1) {
    return {x * w, y * w, 0.5 * w, w};
}

/// How often each pixel centre is covered.
std::vector<int> counts(const std::vector<glm::dvec4>& triangles, Extent2D size) {
    std::vector<int> out(std::size_t{size.width} * size.height, 0);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const RasterTriangle triangle(triangles[t], triangles[t + 1], triangles[t + 2]);
        const PixelRect box = triangle.bounds(size);
        for (std::int32_t y = box.top; y < box.bottom; ++y)
            for (std::int32_t x = box.left; x < box.right; ++x)
                out[static_cast<std::size_t>(y) * size.width + static_cast<std::size_t>(x)] +=
                    triangle.covers(sample_point(x, y, size));
    }
    return out;
}
void require_once(const std::vector<glm::dvec4>& triangles, Extent2D size) {
    const std::vector<int> found = counts(triangles, size);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i] != 1)
            FAIL("pixel (" << i % size.width << ", " << i / size.width << ") is covered " << found[i] << " times");
}

}  // namespace

TEST_CASE("samples are whole numbers: centres, row 0 at the top, and steps of 1/64 pixel", "[cpu]") {
    const SamplePoint first = sample_point(0, 0, {4, 2});
    CHECK(first.x / first.w == -0.75);
    CHECK(first.y / first.w == 0.5);
    const SamplePoint last = sample_point(3, 1, {4, 2}, 1, -1);
    CHECK(last.x / last.w == 0.75 + 2.0 / 4 / 64);
    CHECK(last.y / last.w == -0.5 + 2.0 / 2 / 64);
    CHECK(sample_point(65535, 65535, {65536, 65536}, 1, 1).x == (32.0 * 65535 + 1) * 65536);
}

TEST_CASE("a centre on an edge belongs to the left and the top edge", "[cpu]") {
    const Extent2D size{8, 8};
    // A square whose four edges run through centres: pixels 2 … 5 are its left, inside and right columns.
    const glm::dvec4 a = on(sample_point(2, 2, size)), b = on(sample_point(2, 5, size)),
                     c = on(sample_point(5, 5, size)), d = on(sample_point(5, 2, size));
    for (const auto& triangles : {std::vector{a, b, c, a, c, d}, std::vector{b, c, d, b, d, a},
                                  std::vector{c, b, a, d, c, a}}) {  // the last one is seen from behind
        const std::vector<int> found = counts(triangles, size);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                CAPTURE(x, y);
                CHECK(found[y * 8 + x] == (x >= 2 && x < 5 && y >= 2 && y < 5));
            }
    }
    // One triangle: its diagonal from the lower left to the upper right is a right edge of the upper half.
    CHECK(RasterTriangle(a, b, d).covers(sample_point(2, 2, size)));
    CHECK_FALSE(RasterTriangle(a, b, d).covers(sample_point(4, 3, size)));
    CHECK(RasterTriangle(b, c, d).covers(sample_point(4, 3, size)));
    CHECK_FALSE(RasterTriangle(a, b, d).covers(sample_point(2, 5, size)));
}

TEST_CASE("fans around a pixel centre and through others cover every centre once", "[cpu]") {
    Random random(5);
    for (const Extent2D size : {Extent2D{16, 16}, Extent2D{23, 17}, Extent2D{100, 7}})
        for (int round = 0; round < 60; ++round) {
            const auto x = static_cast<std::int64_t>(random.uniform(0, size.width));
            const auto y = static_cast<std::int64_t>(random.uniform(0, size.height));
            const double scale = round % 3 == 0 ? 1.0 : random.uniform(0.001, 1000);  // rounding of the vertex itself
            const glm::dvec4 middle = on(sample_point(x, y, size), scale);
            // A rim far outside, each point in line with the middle and some other centre, so that edges pass centres.
            const int points = 5 + round % 23;
            std::vector<glm::dvec4> rim;
            for (int i = 0; i < points; ++i) {
                const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.9)) / points;
                const double w = random.uniform(0.01, 100);
                rim.push_back(at(9 * std::cos(angle), 9 * std::sin(angle), w));
            }
            std::vector<glm::dvec4> triangles;
            for (int i = 0; i < points; ++i) {
                const glm::dvec4 corners[] = {middle, rim[i], rim[(i + 1) % points]};
                for (int k = 0; k < 3; ++k) triangles.push_back(corners[(k + i) % 3]);
            }
            if (round % 2) std::reverse(triangles.begin(), triangles.end());  // all seen from behind
            require_once(triangles, size);
        }
}

TEST_CASE("grids with vertices on centres and on corners cover every centre once", "[cpu]") {
    Random random(6);
    for (const Extent2D size : {Extent2D{12, 12}, Extent2D{13, 9}})
        for (const int stretch : {1, 2, 3})
            for (int round = 0; round < 8; ++round) {
                // Vertices at every `stretch`-th centre, from outside the picture on; each with a w of its own.
                const auto index = [](int v, int step) { return std::int64_t{v - 2} * step; };
                const int columns = static_cast<int>(size.width) / stretch + 6;
                const int rows = static_cast<int>(size.height) / stretch + 6;
                std::vector<glm::dvec4> vertices;
                for (int j = 0; j < rows; ++j)
                    for (int i = 0; i < columns; ++i)
                        vertices.push_back(on(sample_point(index(i, stretch), index(j, stretch), size),
                                              round == 0 ? 1.0 : random.uniform(0.1, 10)));
                std::vector<glm::dvec4> triangles;
                for (int j = 0; j + 1 < rows; ++j)
                    for (int i = 0; i + 1 < columns; ++i) {
                        const glm::dvec4 a = vertices[j * columns + i], b = vertices[(j + 1) * columns + i],
                                         c = vertices[(j + 1) * columns + i + 1], d = vertices[j * columns + i + 1];
                        const bool other = random.uniform() < 0.5;  // either diagonal
                        const std::vector<glm::dvec4> pair =
                            other ? std::vector{b, c, d, d, a, b} : std::vector{a, b, c, c, d, a};
                        triangles.insert(triangles.end(), pair.begin(), pair.end());
                    }
                require_once(triangles, size);
            }
}

TEST_CASE("slivers, down to one part in 1e15 of their length, cover every centre once", "[cpu]") {
    Random random(7);
    const Extent2D size{32, 24};
    for (int round = 0; round < 20; ++round) {
        // One square of [−1.1, 1.1]², cut into strips of very unequal width by lines that all pass near one point.
        std::vector<double> cuts = {-1.1, 1.1};
        const double centre =
            sample_point(static_cast<std::int64_t>(random.uniform(0, 32)), 3, size).x / (32.0 * 32 * 24);
        for (int i = 0; i < 30; ++i)
            cuts.push_back(centre + std::pow(10.0, random.uniform(-17, -1)) * random.uniform(-1, 1));
        std::sort(cuts.begin(), cuts.end());
        std::vector<glm::dvec4> triangles;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const glm::dvec4 a = at(cuts[i], 1.1), b = at(cuts[i], -1.1), c = at(cuts[i + 1], -1.1),
                             d = at(cuts[i + 1], 1.1);
            triangles.insert(triangles.end(), {a, b, c, a, c, d});
        }
        require_once(triangles, size);
        // What covers a centre has weights and a depth in range there, however thin it is.
        for (std::size_t t = 0; t < triangles.size(); t += 3) {
            const RasterTriangle triangle(triangles[t], triangles[t + 1], triangles[t + 2]);
            for (std::int64_t x = 0; x < 32; ++x) {
                const SamplePoint sample = sample_point(x, 5, size);
                if (!triangle.covers(sample)) continue;
                const glm::dvec3 k = triangle.weights(sample);
                REQUIRE((k.x >= 0 && k.y >= 0 && k.z >= 0));
                REQUIRE(k.x + k.y + k.z == Approx(1).epsilon(1e-14));
                REQUIRE(*triangle.depth(sample) == 0.5);
            }
        }
    }
}

TEST_CASE("a ground that reaches behind the eye covers every centre below the horizon once, and none above", "[cpu]") {
    const Extent2D size{40, 30};
    Random random(8);
    // The plane y = −1 in view space, from x, z = −1000 to 1000 around the eye; clip = (f x, f y, near, −z).
    const double f = 1.3, near = 0.01;
    const auto project = [&](double x, double z) { return glm::dvec4(f * x, -f, near, -z); };
    for (int round = 0; round < 10; ++round) {
        std::vector<double> xs = {-1e3, 1e3}, zs = {-1e3, 1e3};
        for (int i = 0; i < round * 4; ++i)
            xs.push_back(random.uniform(-20, 20)), zs.push_back(random.uniform(-20, 20));
        if (round > 5) zs.push_back(0);  // vertices in the plane of the eye
        std::sort(xs.begin(), xs.end());
        std::sort(zs.begin(), zs.end());
        std::vector<glm::dvec4> triangles;
        for (std::size_t j = 0; j + 1 < zs.size(); ++j)
            for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
                const glm::dvec4 a = project(xs[i], zs[j]), b = project(xs[i], zs[j + 1]),
                                 c = project(xs[i + 1], zs[j + 1]), d = project(xs[i + 1], zs[j]);
                triangles.insert(triangles.end(), {a, b, c, a, c, d});
                // Seen from above it is counter-clockwise, also where it lies partly behind the eye.
                REQUIRE(RasterTriangle(a, b, c).facing() == 1);
            }
        const std::vector<int> found = counts(triangles, size);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                CAPTURE(round, x, y);
                CHECK(found[y * 40 + x] == (y >= 15));
            }
    }
}

TEST_CASE("facing: either way round, edge-on, and what is not finite", "[cpu]") {
    const glm::dvec4 a = at(0, 0), b = at(0.5, 0), c = at(0, 0.5);
    CHECK(RasterTriangle(a, b, c).facing() == 1);
    CHECK(RasterTriangle(a, c, b).facing() == -1);
    CHECK(RasterTriangle(a, b, b).facing() == 0);
    CHECK(RasterTriangle(a, b, at(1, 0, 3)).facing() == 0);
    CHECK(RasterTriangle(a, b, at(1, 1e-16)).facing() == 1);
    CHECK(RasterTriangle(a, b, {std::numeric_limits<double>::infinity(), 0, 0, 1}).facing() == 0);
    CHECK(RasterTriangle(a, b, {0, 0, 0, std::numeric_limits<double>::quiet_NaN()}).facing() == 0);
    CHECK_FALSE(RasterTriangle(a, b, b).covers(sample_point(4, 3, {8, 8})));
    CHECK(RasterTriangle(a, b, b).bounds({8, 8}).empty());
    CHECK(RasterTriangle(-a, -b, -c).bounds({8, 8}).empty());  // all behind the eye
}

TEST_CASE("bounds and the miss of a box never lose a covered sample", "[cpu]") {
    Random random(9);
    const Extent2D size{24, 16};
    int missed = 0, covered = 0;
    for (int i = 0; i < 6000; ++i) {
        glm::dvec4 v[3];
        for (glm::dvec4& p : v) {
            const double w = random.uniform(i % 3 == 0 ? -1 : 0.02, 2);
            p = {random.uniform(-2, 2), random.uniform(-2, 2), i % 2 ? 0.01 : random.uniform(-0.3, 1), w};
        }
        const RasterTriangle triangle(v[0], v[1], v[2]);
        const PixelRect box = triangle.bounds(size), wide = triangle.bounds(size, 1.0 / 64);
        const PixelRect tile{8, 4, 16, 12};
        const bool misses = triangle.misses(sample_point(8, 4, size), sample_point(15, 11, size));
        missed += misses;
        for (std::int32_t y = 0; y < 16; ++y)
            for (std::int32_t x = 0; x < 24; ++x) {
                const PixelRect pixel{x, y, x + 1, y + 1};
                const SamplePoint sample = sample_point(x, y, size);
                const bool hit = triangle.covers(sample);
                covered += hit;
                // Where it is in front of the near plane or beyond the far end, bounds may leave it out.
                if (hit && triangle.depth(sample)) REQUIRE_FALSE(intersection(box, pixel).empty());
                if (misses && !intersection(tile, pixel).empty()) REQUIRE_FALSE(hit);
                for (const int step : {-1, 1}) {
                    const SamplePoint moved = sample_point(x, y, size, step, -step);
                    if (triangle.covers(moved) && triangle.depth(moved))
                        REQUIRE_FALSE(intersection(wide, pixel).empty());
                }
            }
    }
    CHECK(missed > 1000);
    CHECK(covered > 10000);
}

TEST_CASE("depth is near/distance, cut at the near plane and at an orthographic far end, both included", "[cpu]") {
    const Extent2D size{16, 16};
    const Camera eye{.vertical_fov = 1, .near = 0.3};
    const ClipFromView clip = clip_from_view(eye, size);
    const auto triangle = [&](const ClipFromView& c, double z0, double z1) {  // from z0 at the left to z1 at the right
        return RasterTriangle(clip_from_point(c, {-9, -9, z0}), clip_from_point(c, {9, -9, z1}),
                              clip_from_point(c, {0, 99, 0.5 * (z0 + z1)}));
    };
    const SamplePoint middle = sample_point(7, 9, size);
    CHECK(triangle(clip, -3, -3).depth(middle) == 0.3 / 3);
    CHECK(triangle(clip, -0.3, -0.3).depth(middle) == 1.0);
    CHECK(triangle(clip, -0.299999, -0.299999).depth(middle) == std::nullopt);
    // A plane through the near plane: z = −0.3 where 1 unit from the middle.
    const RasterTriangle slanted = triangle(clip, -2.1, 1.5);  // z = −0.3 + 0.2 x
    for (int x = 0; x < 16; ++x) {
        const SamplePoint sample = sample_point(x, 9, size);
        if (!slanted.covers(sample)) continue;
        const double ndc = sample.x / sample.w / clip.sx;  // x = ndc · distance; distance = 0.3 − 0.2 x
        const double distance = 0.3 / (1 + 0.2 * ndc);
        CAPTURE(x);
        CHECK(slanted.depth(sample).has_value() == (ndc <= 0));
        if (ndc <= 0) CHECK(*slanted.depth(sample) == Approx(0.3 / distance).epsilon(1e-14));
    }
    const Camera flat{.projection = Projection::orthographic, .half_height = 8, .near = 1, .far = 5};
    const ClipFromView parallel = clip_from_view(flat, size);
    CHECK(triangle(parallel, -1, -1).depth(middle) == 1.0);
    CHECK(triangle(parallel, -2, -2).depth(middle) == 0.75);
    CHECK(triangle(parallel, -5, -5).depth(middle) == 0.0);
    CHECK(triangle(parallel, -5.0001, -5.0001).depth(middle) == std::nullopt);
    CHECK(triangle(parallel, -0.9999, -0.9999).depth(middle) == std::nullopt);
    const RasterTriangle both = triangle(parallel, -8, 2);  // z = −3 + 5/9 x: within [1, 5] for |x| <= 3.6
    for (int x = 0; x < 16; ++x) {
        const SamplePoint sample = sample_point(x, 9, size);
        if (both.covers(sample)) CHECK(both.depth(sample).has_value() == (std::abs(8 * sample.x / sample.w) <= 3.6));
    }
}

TEST_CASE("weights are perspective-correct, and extrapolate on the plane", "[cpu]") {
    const Extent2D size{16, 16};
    // Corner 0 at distance 1, the others at distance 3: half-way on screen is a quarter of the way in space.
    const RasterTriangle triangle({-1, -1, 0.1, 1}, {3, -3, 0.1, 3}, {-3, 3, 0.1, 3});
    for (const double t : {0.125, 0.25, 0.5, 0.875}) {
        const SamplePoint sample{-1 + 2 * t, -1, 1};  // on the edge from corner 0 to corner 1
        const double far = t / 3 / (t / 3 + (1 - t));
        const glm::dvec3 k = triangle.extrapolated_weights(sample);
        CHECK(k.x == Approx(1 - far).epsilon(1e-14));
        CHECK(k.y == Approx(far).epsilon(1e-14));
        CHECK(k.z == Approx(0).margin(1e-15));
    }
    const glm::dvec3 outside = triangle.extrapolated_weights({-1.5, -1, 1});
    CHECK(outside.y == Approx((-0.25 / 3) / (-0.25 / 3 + 1.25)).epsilon(1e-14));
    CHECK(outside.x + outside.y + outside.z == Approx(1).epsilon(1e-14));
    // A triangle of a millionth of a pixel has as many digits as a large one.
    const SamplePoint centre = sample_point(5, 11, size);
    const double x = centre.x / centre.w, y = centre.y / centre.w, s = 1e-7;
    const RasterTriangle tiny(at(x - s, y - s), at(x + 3 * s, y - s), at(x - s, y + 3 * s));
    const glm::dvec3 k = tiny.weights(centre);
    CHECK(k.x == Approx(0.5).epsilon(1e-8));  // what the corners' own rounding leaves of 1e-7
    CHECK(k.y == Approx(0.25).epsilon(1e-8));
}

TEST_CASE("weights of a covered sample are never below 0, also where it is on an edge up to rounding", "[cpu]") {
    Random random(12);
    const Extent2D size{64, 48};
    int covered = 0, below = 0;
    for (int i = 0; i < 50000; ++i) {
        const SamplePoint s = sample_point(static_cast<std::int64_t>(random.uniform(0, 64)), 20, size);
        const auto corner = [&] { return at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 3)); };
        const glm::dvec4 p = corner(), other = corner();
        const double t = random.uniform(1, 3);  // q lies beyond the sample, as seen from p
        const double px = p.x / p.w, py = p.y / p.w;
        const glm::dvec4 q = at(px + t * (s.x / s.w - px), py + t * (s.y / s.w - py), random.uniform(0.1, 3));
        const RasterTriangle triangle(p, q, other);
        if (!triangle.covers(s)) continue;
        ++covered;
        const glm::dvec3 k = triangle.weights(s), e = triangle.extrapolated_weights(s);
        below += std::min({e.x, e.y, e.z}) < 0;
        REQUIRE(std::min({k.x, k.y, k.z}) >= 0);
        REQUIRE(std::max({k.x, k.y, k.z}) <= 1);
        REQUIRE(k.x + k.y + k.z == Approx(1).epsilon(1e-15));
    }
    CHECK(covered > 10000);
    CHECK(below > 100);  // or the limit would not be needed
}

TEST_CASE("mixing equal values gives the value, to the bit", "[cpu]") {
    Random random(10);
    for (int i = 0; i < 10000; ++i) {
        const double value = random.uniform(-1e6, 1e6);
        const glm::dvec3 e(random.uniform(), random.uniform(), random.uniform());
        const glm::dvec3 k = e / (e.x + e.y + e.z);
        REQUIRE(mixed(value, value, value, k) == value);
    }
    // A far corner of little weight: the others' digits stay, whichever corner it is.
    const double share = 1e-12, expected = 1.499 - 2e-12;
    CHECK(mixed(1.0, 2.0, -1e9, {0.5, 0.5 - share, share}) == Approx(expected).epsilon(1e-15));
    CHECK(mixed(-1e9, 1.0, 2.0, {share, 0.5, 0.5 - share}) == Approx(expected).epsilon(1e-15));
    CHECK(mixed(2.0, -1e9, 1.0, {0.5 - share, share, 0.5}) == Approx(expected).epsilon(1e-15));
}
