// SPDX-License-Identifier: MIT
/// \file
/// Newell's teapot: the control points fit together, the mesh is on the exact surface and closed where it should be.
#include <pellucid/scene/teapot.hpp>
#include <glm/common.hpp>
#include <set>
#include "scene/mesh_checks.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// A point of a patch by de Casteljau's construction, which shares nothing with Bernstein polynomials.
glm::dvec3 point_on(const BezierPatch& patch, double s, double t) {
    const auto curve = [](const glm::dvec3(&p)[4], double x) {
        glm::dvec3 q[4] = {p[0], p[1], p[2], p[3]};
        for (int level = 3; level > 0; --level)
            for (int i = 0; i < level; ++i) q[i] = glm::mix(q[i], q[i + 1], x);
        return q[0];
    };
    glm::dvec3 column[4];
    for (int row = 0; row < 4; ++row) column[row] = curve(patch.points[row], s);
    return curve(column, t);
}

/// dP/ds and dP/dt by central differences of fourth order.
std::pair<glm::dvec3, glm::dvec3> slopes(const BezierPatch& patch, double s, double t) {
    constexpr double h = 1e-3;
    const auto difference = [&](auto&& p) { return (8.0 * (p(h) - p(-h)) - (p(2 * h) - p(-2 * h))) / (12 * h); };
    return {difference([&](double d) { return point_on(patch, s + d, t); }),
            difference([&](double d) { return point_on(patch, s, t + d); })};
}

enum Side { top, bottom, left, right };
glm::dvec3 border_point(const BezierPatch& patch, Side side, double x) {
    return side == top      ? point_on(patch, x, 0)
           : side == bottom ? point_on(patch, x, 1)
                            : point_on(patch, side == left ? 0 : 1, x);
}
/// Largest distance of two borders, both run through in the direction of rising parameters.
double border_distance(const BezierPatch& a, Side a_side, const BezierPatch& b, Side b_side) {
    double largest = 0;
    for (int i = 0; i <= 16; ++i)
        largest =
            std::max(largest, glm::distance(border_point(a, a_side, i / 16.0), border_point(b, b_side, i / 16.0)));
    return largest;
}

/// A part of the teapot: rows of patches, `across` in each.
struct Part {
    const char* name;
    std::size_t first, across, rows;
};
constexpr Part lid{"lid", 0, 4, 2}, body{"body", 8, 4, 3}, base{"bottom", 20, 4, 1}, handle{"handle", 24, 2, 2},
    spout{"spout", 28, 2, 2};

/// The volume between the vessel (lid, body, bottom) and the plane of the gap between lid and rim, y = 2.4, which adds
/// nothing to the flux of (0, y - 2.4, 0).  The integrand is a polynomial of degree 8 in s and in t, for which
/// Gauss-Legendre with five points is exact.
double exact_vessel_volume(const std::vector<BezierPatch>& patches) {
    const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3, outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
    const double w0 = 128.0 / 225, w1 = (322 + 13 * std::sqrt(70.0)) / 900, w2 = (322 - 13 * std::sqrt(70.0)) / 900;
    const std::pair<double, double> gauss[] = {{0, w0}, {inner, w1}, {-inner, w1}, {outer, w2}, {-outer, w2}};
    double sum = 0;
    for (std::size_t p = 0; p < handle.first; ++p)
        for (const auto& [x, wx] : gauss)
            for (const auto& [y, wy] : gauss) {
                const double s = 0.5 + 0.5 * x, t = 0.5 + 0.5 * y;
                const auto [ds, dt] = slopes(patches[p], s, t);
                sum += 0.25 * wx * wy * (point_on(patches[p], s, t).y - 2.4) * glm::cross(dt, ds).y;
            }
    return sum;
}

/// The parts of a mesh that hang together by edges, the biggest first.
std::vector<Mesh> components(const Mesh& mesh) {
    std::map<std::pair<Point, Point>, std::size_t> triangles;  // by their directed edges
    std::vector<std::size_t> parent(mesh.indices.size() / 3);
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    const auto edge = [&](std::size_t i) {
        return std::pair(point_of(mesh, mesh.indices[i]), point_of(mesh, mesh.indices[i % 3 == 2 ? i - 2 : i + 1]));
    };
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        if (i % 3 == 0) parent[i / 3] = i / 3;
        triangles[edge(i)] = i / 3;
        const auto across = triangles.find({edge(i).second, edge(i).first});
        if (across != triangles.end()) parent[root(i / 3)] = root(across->second);
    }
    std::map<std::size_t, Mesh> parts;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        Mesh& part = parts[root(i / 3)];
        if (part.positions.empty()) part.positions = mesh.positions;
        part.indices.push_back(mesh.indices[i]);
    }
    std::vector<Mesh> list;
    for (auto& [key, part] : parts) list.push_back(std::move(part));
    std::sort(list.begin(), list.end(),
              [](const Mesh& a, const Mesh& b) { return a.indices.size() > b.indices.size(); });
    return list;
}

/// One point of every ring and section of another copy of the data (P. Schneider, 1990): from the body's foot up, and
/// divided by 3.525, to six digits.
constexpr glm::dvec3 other_copy[] = {{0.397163, 0.638298, -0.222411},
                                     {0.379433, 0.675532, -0.212482},
                                     {0.407801, 0.675532, -0.228369},
                                     {0.425532, 0.638298, -0.238298},
                                     {0.496454, 0.489362, -0.278014},
                                     {0.567376, 0.340426, -0.31773},
                                     {0.567376, 0.212766, -0.31773},
                                     {0.567376, 0.0851064, -0.31773},
                                     {0.425532, 0.0212766, -0.238298},
                                     {0.425532, 0, -0.238298},
                                     {-0.453901, 0.531915, -0.0851064},
                                     {-0.425532, 0.595745, -0.0851064},
                                     {-0.652482, 0.531915, -0.0851064},
                                     {-0.70922, 0.595745, -0.0851064},
                                     {-0.765957, 0.531915, -0.0851064},
                                     {-0.851064, 0.595745, -0.0851064},
                                     {-0.765957, 0.468085, -0.0851064},
                                     {-0.851064, 0.468085, -0.0851064},
                                     {-0.765957, 0.404255, -0.0851064},
                                     {-0.851064, 0.340426, -0.0851064},
                                     {-0.70922, 0.276596, -0.0851064},
                                     {-0.751773, 0.223404, -0.0851064},
                                     {-0.567376, 0.212766, -0.0851064},
                                     {-0.539007, 0.12766, -0.0851064},
                                     {0.482269, 0.361702, -0.187234},
                                     {0.482269, 0.12766, -0.187234},
                                     {0.737589, 0.361702, -0.187234},
                                     {0.879433, 0.191489, -0.187234},
                                     {0.652482, 0.553191, -0.070922},
                                     {0.680851, 0.531915, -0.070922},
                                     {0.765957, 0.638298, -0.070922},
                                     {0.93617, 0.638298, -0.070922},
                                     {0.794326, 0.659574, -0.070922},
                                     {1, 0.664894, -0.070922},
                                     {0.822695, 0.659574, -0.0425532},
                                     {0.978723, 0.670213, -0.0425532},
                                     {0.794326, 0.638298, -0.0425532},
                                     {0.907801, 0.638298, -0.0425532},
                                     {0, 0.851064, 0},
                                     {0.22695, 0.851064, -0.12766},
                                     {0, 0.765957, 0},
                                     {0.0567376, 0.723404, -0.031773},
                                     {0.113475, 0.680851, -0.0635461},
                                     {0.368794, 0.680851, -0.206525},
                                     {0.368794, 0.638298, -0.206525}};

}  // namespace

TEST_CASE("the teapot's control points are those of another copy", "[cpu][teapot]") {
    std::vector<glm::dvec3> points;
    for (const BezierPatch& patch : teapot_patches(false))
        for (const auto& row : patch.points) points.insert(points.end(), std::begin(row), std::end(row));
    CHECK(points.size() == 28 * 16);
    for (const glm::dvec3& other : other_copy) {
        const glm::dvec3 wanted = 3.525 * other + glm::dvec3(0, 0.15, 0);
        double nearest = 1;
        for (const glm::dvec3& point : points) nearest = std::min(nearest, glm::distance(point, wanted));
        INFO(wanted.x << " " << wanted.y << " " << wanted.z);
        CHECK(nearest < 4e-6);
    }
    // And there are no others: the copy has 269, four of which are beside the knob's tip.
    std::set<std::tuple<double, double, double>> distinct;
    for (const glm::dvec3& p : points) distinct.insert({p.x, p.y, p.z});
    CHECK(distinct.size() == 265);
}

TEST_CASE("the teapot's patches meet, without a gap and without a fold", "[cpu][teapot]") {
    const std::vector<BezierPatch> patches = teapot_patches();
    REQUIRE(patches.size() == 32);
    CHECK(teapot_patches(false).size() == 28);
    int joints = 0;
    for (const Part& part : {lid, body, base, handle, spout}) {
        INFO(part.name);
        for (std::size_t row = 0; row < part.rows; ++row)
            for (std::size_t column = 0; column < part.across; ++column) {
                const BezierPatch& here = patches[part.first + row * part.across + column];
                const BezierPatch& beside = patches[part.first + row * part.across + (column + 1) % part.across];
                CHECK(border_distance(here, right, beside, left) < 1e-6);
                ++joints;
                for (const double x : {0.1, 0.5, 0.8}) {  // normals are the same on both sides, too
                    const auto [ds, dt] = slopes(here, 1, x);
                    const auto [beside_ds, beside_dt] = slopes(beside, 0, x);
                    CHECK(glm::dot(glm::normalize(glm::cross(dt, ds)),
                                   glm::normalize(glm::cross(beside_dt, beside_ds))) > 1 - 1e-9);
                }
                if (row + 1 == part.rows) continue;
                const BezierPatch& below = patches[part.first + (row + 1) * part.across + column];
                CHECK(border_distance(here, bottom, below, top) < 1e-6);
                ++joints;
            }
    }
    for (std::size_t column = 0; column < 4; ++column) {
        const BezierPatch &foot = patches[body.first + 8 + column], &under = patches[base.first + column];
        CHECK(border_distance(foot, bottom, under, top) < 1e-6);
        CHECK(glm::normalize(slopes(foot, 0.3, 1).second).y == Approx(glm::normalize(slopes(under, 0.3, 0).second).y));
    }
    CHECK(joints == 32 + 4 + 8 + 2 + 2);
    // What is open: the lid's edge and the rim's inner edge, in one plane.
    for (int i = 0; i <= 8; ++i) {
        CHECK(border_point(patches[lid.first + 4], bottom, i / 8.0).y == Approx(2.4));
        CHECK(border_point(patches[body.first], top, i / 8.0).y == Approx(2.4));
    }
}

TEST_CASE("the teapot's patches mirror each other", "[cpu][teapot]") {
    const std::vector<BezierPatch> patches = teapot_patches();
    for (const Part& part : {lid, body, base})
        for (std::size_t p = part.first; p < part.first + part.across * part.rows; ++p)
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column) {
                    // Quarters: across the planes x = z and x = -z through their own middle, and from one to the next.
                    const glm::dvec3 here = patches[p].points[row][column],
                                     mirrored = patches[p].points[row][3 - column];
                    const bool odd = (p - part.first) % 2 == 1;
                    CHECK(here ==
                          glm::dvec3(odd ? mirrored.z : -mirrored.z, mirrored.y, odd ? mirrored.x : -mirrored.x));
                    const std::size_t next = p % 4 == 3 ? p - 3 : p + 1;
                    CHECK(patches[next].points[row][column] == glm::dvec3(here.z, here.y, -here.x));
                }
    for (const Part& part : {handle, spout})
        for (std::size_t p = part.first; p < part.first + 4; p += 2)
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column)
                    CHECK(patches[p].points[row][column] ==
                          patches[p + 1].points[row][3 - column] * glm::dvec3(1, 1, -1));
}

TEST_CASE("every vertex of a teapot is on the surface, with the surface's normal", "[cpu][teapot]") {
    constexpr std::uint32_t n = 6;
    const Mesh mesh = make_teapot(n);
    std::map<Point, std::vector<glm::dvec3>> normals;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        normals[point_of(mesh, v)].push_back(glm::dvec3(mesh.normals[v]));
    std::size_t found = 0;
    double farthest = 0;
    for (const BezierPatch& patch : teapot_patches())
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j) {
                const double s = static_cast<double>(j) / n, t = static_cast<double>(i) / n;
                const glm::dvec3 wanted = point_on(patch, s, t);
                double distance = 1;
                const std::vector<glm::dvec3>* there = nullptr;
                for (const auto& [point, list] : normals) {
                    const double d =
                        glm::distance(wanted, glm::dvec3(std::get<0>(point), std::get<1>(point), std::get<2>(point)));
                    if (d < distance) distance = d, there = &list;
                }
                farthest = std::max(farthest, distance);
                if (!there) continue;
                ++found;
                auto [ds, dt] = slopes(patch, s, t);
                if (glm::length(ds) < 1e-6) ds = slopes(patch, s, t < 0.5 ? 1e-3 : 1 - 1e-3).first;  // near the pole
                const glm::dvec3 normal = glm::normalize(glm::cross(dt, ds));
                double nearest = 2;
                for (const glm::dvec3& candidate : *there)
                    nearest = std::min(nearest, glm::distance(candidate, normal));
                CHECK(nearest < 1e-6);
            }
    CHECK(farthest < 3e-7);
    CHECK(found == 32 * (n + 1) * (n + 1));
}

TEST_CASE("a teapot's mesh is valid at every fineness", "[cpu][teapot]") {
    for (const std::uint32_t n : {2u, 3u, 6u, 7u, 16u, 29u}) {
        INFO(n);
        for (const TeapotSurface surface :
             {TeapotSurface::original, TeapotSurface::with_bottom, TeapotSurface::closed}) {
            const Mesh mesh = make_teapot(n, surface);
            check_valid(mesh, n >= 6);
            CHECK(mesh.name == "teapot");
            for (const glm::vec2& uv : mesh.uv0) REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
            for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {  // u to the right, v down, seen from outside
                const glm::dvec2 a(mesh.uv0[mesh.indices[t]]), b(mesh.uv0[mesh.indices[t + 1]]),
                    c(mesh.uv0[mesh.indices[t + 2]]);
                REQUIRE((b - a).x * (c - a).y - (b - a).y * (c - a).x < 0);
            }
            CHECK((mesh.lower == glm::vec3(-3, surface == TeapotSurface::original ? 0.15f : 0.0f, -2)));
            CHECK((mesh.upper.y == 3.15f && mesh.upper.z == 2.0f));
        }
        CHECK(make_teapot(n, TeapotSurface::original).indices.size() / 3 == 56 * n * n - 4 * n);
        CHECK(make_teapot(n).indices.size() / 3 == 64 * n * n - 8 * n);
        CHECK(make_teapot(n, TeapotSurface::closed).indices.size() / 3 == 64 * n * n + 8 * n - 8);
        const Mesh once = make_teapot(n), again = make_teapot(n);
        CHECK((once.positions == again.positions && once.normals == again.normals && once.indices == again.indices));
    }
    // The spout's lip, where the border of its outer side has no slope in x any more.
    double lip = 0;
    const BezierPatch outer = teapot_patches()[spout.first + 2];
    for (int i = 0; i <= 4096; ++i) lip = std::max(lip, point_on(outer, 1, i / 4096.0).x);
    CHECK(make_teapot(64).upper.x == Approx(lip).margin(1e-4));
    CHECK(lip == Approx(3.434).margin(5e-4));
}

TEST_CASE("a teapot is open only where it should be", "[cpu][teapot]") {
    for (const std::uint32_t n : {2u, 5u, 12u}) {
        INFO(n);
        CHECK(closed(make_teapot(n, TeapotSurface::closed)));
        // Lid's edge and rim, 4 n edges each; both ends of handle and spout, 2 n each.
        CHECK(open_edges(make_teapot(n)).size() == 2 * 4 * n + 4 * 2 * n);
        // The body's foot as well.
        const auto open = open_edges(make_teapot(n, TeapotSurface::original));
        CHECK(open.size() == 3 * 4 * n + 4 * 2 * n);
        std::set<float> heights;
        for (const auto& [from, to] : open)
            if (std::get<1>(from) == std::get<1>(to)) heights.insert(std::get<1>(from));
        CHECK((heights.count(0.15f) == 1 && heights.count(2.4f) == 1));
    }
}

TEST_CASE("a closed teapot holds what its patches hold", "[cpu][teapot]") {
    const double vessel = exact_vessel_volume(teapot_patches());
    std::vector<double> held[3];  // vessel, handle, spout; for each fineness
    for (const std::uint32_t n : {8u, 16u, 32u}) {
        const std::vector<Mesh> parts = components(make_teapot(n, TeapotSurface::closed));
        REQUIRE(parts.size() == 3);
        for (const Mesh& part : parts) {
            CHECK(closed(part));
            const float x = part.positions[part.indices[0]].x;
            held[&part == &parts[0] ? 0 : x < 0 ? 1 : 2].push_back(volume(part));
        }
    }
    for (const std::vector<double>& v : held) {
        REQUIRE(v.size() == 3);
        CHECK(v[0] > 0);
        // The error is of second order: it falls to a quarter each time the step is halved.
        CHECK((v[1] - v[0]) / (v[2] - v[1]) == Approx(4).epsilon(0.03));
    }
    CHECK((vessel - held[0][1]) / (vessel - held[0][2]) == Approx(4).epsilon(0.01));
    // Extrapolated to no step at all it is the patches' own.
    CHECK(held[0][2] + (held[0][2] - held[0][1]) / 3 == Approx(vessel).epsilon(1e-6));
}
