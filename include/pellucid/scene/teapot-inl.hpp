// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of teapot.hpp.
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/teapot.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>

namespace pellucid::inline v0_1 {
namespace detail {

// The data set is symmetric, so what is written here is less than its 306 points.  The numbers are those of P.
// Schneider's copy of 1990 ("Martin Newell's teapot made famous by J. Blinn", divided by 3.525 there; four points of
// its knob's tip are 0.002 beside it) and of freeglut's teapot, which has the bottom too.

/// A ring of control points round the y axis: each quarter has its ends at `radius` on two axes, and its inner points
/// `tangent` further along the tangents there (0.56 of the radius; a circle would have 0.5523).
struct TeapotRing {
    double radius, tangent, height;
};
inline constexpr TeapotRing teapot_lid[] = {{0.0, 0.0, 3.15},   {0.8, 0.45, 3.15},  {0.0, 0.0, 2.85}, {0.2, 0.112, 2.7},
                                            {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}};
inline constexpr TeapotRing teapot_body[] = {
    {1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4},   {1.75, 0.98, 1.875},
    {2.0, 1.12, 1.35}, {2.0, 1.12, 0.9},         {2.0, 1.12, 0.45},        {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}};
inline constexpr TeapotRing teapot_bottom[] = {
    {1.5, 0.84, 0.15}, {1.5, 0.84, 0.075}, {1.425, 0.798, 0.0}, {0.0, 0.0, 0.0}};

/// A ring of control points round a tube whose middle is the plane z = 0: two points in that plane, on the inner and
/// the outer side of the bend, and the four points beside them at z = ±`half_width`.
struct TeapotSection {
    double inner_x, inner_y, outer_x, outer_y, half_width;
};
inline constexpr TeapotSection teapot_handle[] = {{-1.6, 2.025, -1.5, 2.25, 0.3}, {-2.3, 2.025, -2.5, 2.25, 0.3},
                                                  {-2.7, 2.025, -3.0, 2.25, 0.3}, {-2.7, 1.8, -3.0, 1.8, 0.3},
                                                  {-2.7, 1.575, -3.0, 1.35, 0.3}, {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                                  {-2.0, 0.9, -1.9, 0.6, 0.3}};
inline constexpr TeapotSection teapot_spout[] = {{1.7, 1.425, 1.7, 0.6, 0.66},       {2.6, 1.425, 3.1, 0.825, 0.66},
                                                 {2.3, 2.1, 2.4, 2.025, 0.25},       {2.7, 2.4, 3.3, 2.4, 0.25},
                                                 {2.8, 2.475, 3.525, 2.49375, 0.25}, {2.9, 2.475, 3.45, 2.5125, 0.15},
                                                 {2.8, 2.4, 3.2, 2.4, 0.15}};

/// Rows of four patches between rings; the last ring of a row is the first of the next.
inline void add_ring_patches(std::vector<BezierPatch>& patches, std::span<const TeapotRing> rings) {
    constexpr glm::dvec3 axes[] = {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}};
    for (std::size_t first = 0; first + 3 < rings.size(); first += 3)
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
            const glm::dvec3 from = axes[quarter], to = axes[(quarter + 1) % 4];
            BezierPatch& patch = patches.emplace_back();
            for (std::size_t row = 0; row < 4; ++row) {
                const TeapotRing& ring = rings[first + row];
                const glm::dvec3 center(0, ring.height, 0);
                patch.points[row][0] = center + ring.radius * from;
                patch.points[row][1] = center + ring.radius * from + ring.tangent * to;
                patch.points[row][2] = center + ring.tangent * from + ring.radius * to;
                patch.points[row][3] = center + ring.radius * to;
            }
        }
}

/// Rows of two patches between sections: from the inner side over -z to the outer side, and back over +z.
inline void add_tube_patches(std::vector<BezierPatch>& patches, std::span<const TeapotSection> sections) {
    for (std::size_t first = 0; first + 3 < sections.size(); first += 3)
        for (const bool back : {false, true}) {
            BezierPatch& patch = patches.emplace_back();
            for (std::size_t row = 0; row < 4; ++row) {
                const TeapotSection& at = sections[first + row];
                const glm::dvec3 inner(at.inner_x, at.inner_y, 0), outer(at.outer_x, at.outer_y, 0);
                const glm::dvec3 from = back ? outer : inner, to = back ? inner : outer;
                const glm::dvec3 side(0, 0, back ? at.half_width : -at.half_width);
                patch.points[row][0] = from;
                patch.points[row][1] = from + side;
                patch.points[row][2] = to + side;
                patch.points[row][3] = to;
            }
        }
}

/// A point of a patch and its outward unit normal.
struct SurfacePoint {
    glm::dvec3 position, normal;
};
/// At s and t of exactly 0 and 1 only the control points there count, so patches that share them meet bit by bit.
inline SurfacePoint evaluate_patch(const BezierPatch& patch, double s, double t) {
    const auto weights = [](double x, double(&value)[4], double(&slope)[4]) {
        const double y = 1.0 - x;
        value[0] = y * y * y, value[1] = 3.0 * x * y * y, value[2] = 3.0 * x * x * y, value[3] = x * x * x;
        slope[0] = -3.0 * y * y, slope[1] = 3.0 * y * (y - 2.0 * x), slope[2] = 3.0 * x * (2.0 * y - x);
        slope[3] = 3.0 * x * x;
    };
    double bs[4], ds[4], bt[4], dt[4];
    weights(s, bs, ds);
    weights(t, bt, dt);
    glm::dvec3 position(0), along_s(0), along_t(0), mixed(0);
    for (int row = 0; row < 4; ++row) {
        glm::dvec3 point(0), slope(0);
        for (int column = 0; column < 4; ++column) {
            point += bs[column] * patch.points[row][column];
            slope += ds[column] * patch.points[row][column];
        }
        position += bt[row] * point;
        along_t += dt[row] * point;
        along_s += bt[row] * slope;
        mixed += dt[row] * slope;
    }
    // Where a whole row of control points is one point, dP/ds vanishes at that end of t, and its direction tends to
    // that of its derivative (l'Hôpital), which points away from the end.
    if (glm::dot(along_s, along_s) < 1e-24) along_s = t < 0.5 ? mixed : -mixed;
    return {position, glm::normalize(glm::cross(along_t, along_s))};
}

/// Where the vertices of a part are in the mesh: `rows` + 1 rows of `columns` + 1 vertices, the last of which is the
/// first one with another u.  A pole's row has `columns` vertices, one a triangle.
struct TeapotPart {
    std::uint32_t first = 0, columns = 0, rows = 0;
    bool pole_above = false, pole_below = false;

    [[nodiscard]] std::uint32_t vertex(std::uint32_t row, std::uint32_t column) const {
        return first + row * (columns + 1) + column - (pole_above && row > 0 ? 1 : 0);
    }
};

class TeapotMesh {
public:
    explicit TeapotMesh(std::uint32_t divisions) : n_(divisions) { mesh_.name = "teapot"; }

    /// `patches`: whole rows of `across` patches each.
    TeapotPart add_part(std::span<const BezierPatch> patches, std::uint32_t across) {
        const auto down = static_cast<std::uint32_t>(patches.size() / across);
        const auto is_point = [](const BezierPatch& patch, int row) {
            return patch.points[row][0] == patch.points[row][3];
        };
        const TeapotPart part{size(), across * n_, down * n_, is_point(patches.front(), 0),
                              is_point(patches.back(), 3)};
        for (std::uint32_t row = 0; row <= part.rows; ++row) {
            const bool pole = (row == 0 && part.pole_above) || (row == part.rows && part.pole_below);
            const std::uint32_t patch_row = std::min(row / n_, down - 1);
            const double t = static_cast<double>(row - patch_row * n_) / n_;
            for (std::uint32_t column = 0; column < part.columns + (pole ? 0 : 1); ++column) {
                const std::uint32_t patch_column = std::min(column / n_, across - 1);
                const double s = static_cast<double>(column - patch_column * n_) / n_;
                const SurfacePoint point = evaluate_patch(patches[patch_row * across + patch_column], s, t);
                // A pole's vertex belongs to one triangle: its u is that triangle's middle.
                add_vertex(glm::vec3(point.position), glm::vec3(point.normal),
                           {(column + (pole ? 0.5 : 0.0)) / part.columns, static_cast<double>(row) / part.rows});
            }
        }
        for (std::uint32_t row = 0; row < part.rows; ++row)
            for (std::uint32_t column = 0; column < part.columns; ++column) {
                const std::uint32_t a = part.vertex(row, column), b = part.vertex(row + 1, column);
                const bool above = row == 0 && part.pole_above, below = row + 1 == part.rows && part.pole_below;
                if (!above) add_triangle(a, b, a + 1);
                if (!below) add_triangle(above ? a : a + 1, b, b + 1);
            }
        return part;
    }

    /// The flat ring between the last row of `inner` and the first of `outer`, seen from above.
    void add_gap(const TeapotPart& inner, const TeapotPart& outer) {
        const std::uint32_t first = size(), columns = inner.columns;
        for (std::uint32_t column = 0; column <= columns; ++column)
            for (const bool outside : {false, true})
                add_vertex(mesh_.positions[outside ? outer.vertex(0, column) : inner.vertex(inner.rows, column)],
                           {0, 1, 0}, {static_cast<double>(column) / columns, outside ? 1.0 : 0.0});
        for (std::uint32_t a = first; a < first + 2 * columns; a += 2) {
            add_triangle(a, a + 1, a + 2);
            add_triangle(a + 2, a + 1, a + 3);
        }
    }

    /// The flat cover of a tube's first or last row: strips between points that mirror each other in z.
    void add_cover(const TeapotPart& tube, bool last) {
        const std::uint32_t first = size(), row = last ? tube.rows : 0;
        const glm::vec3 inner = mesh_.positions[tube.vertex(row, 0)], outer = mesh_.positions[tube.vertex(row, n_)];
        const glm::vec3 up = glm::normalize(glm::cross(outer - inner, glm::vec3(0, 0, 1)));
        for (std::uint32_t column = 0; column < 2 * n_; ++column) {
            const std::uint32_t along = std::min(column, 2 * n_ - column);
            const double across = along == 0 || along == n_ ? 0.5 : (column < n_) != last ? 0.0 : 1.0;
            add_vertex(mesh_.positions[tube.vertex(row, column)], last ? -up : up,
                       {across, static_cast<double>(along) / n_});
        }
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            add_triangle(first + a, first + (last ? c : b), first + (last ? b : c));
        };
        for (std::uint32_t column = 0; column < n_; ++column) {
            const std::uint32_t mirrored = 2 * n_ - column;
            if (column + 1 < n_) add(column, column + 1, mirrored - 1);
            if (column > 0) add(column, mirrored - 1, mirrored);
        }
    }

    Mesh take() {
        update_bounds(mesh_);
        return std::move(mesh_);
    }

private:
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }
    void add_vertex(glm::vec3 position, glm::vec3 normal, glm::dvec2 uv) {
        mesh_.positions.push_back(position);
        mesh_.normals.push_back(normal);
        mesh_.uv0.push_back(glm::vec2(uv));
    }
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    std::uint32_t n_;
    Mesh mesh_;
};

}  // namespace detail

PELLUCID_INLINE std::vector<BezierPatch> teapot_patches(bool bottom) {
    std::vector<BezierPatch> patches;
    patches.reserve(32);
    detail::add_ring_patches(patches, detail::teapot_lid);
    detail::add_ring_patches(patches, detail::teapot_body);
    if (bottom) detail::add_ring_patches(patches, detail::teapot_bottom);
    detail::add_tube_patches(patches, detail::teapot_handle);
    detail::add_tube_patches(patches, detail::teapot_spout);
    return patches;
}

PELLUCID_INLINE Mesh make_teapot(std::uint32_t divisions, TeapotSurface surface) {
    assert(divisions >= 2 && divisions <= 1024);
    const std::vector<BezierPatch> patches = teapot_patches();
    const std::span<const BezierPatch> all(patches);
    detail::TeapotMesh mesh(divisions);
    const detail::TeapotPart lid = mesh.add_part(all.subspan(0, 8), 4), body = mesh.add_part(all.subspan(8, 12), 4);
    if (surface != TeapotSurface::original) mesh.add_part(all.subspan(20, 4), 4);
    const detail::TeapotPart handle = mesh.add_part(all.subspan(24, 4), 2),
                             spout = mesh.add_part(all.subspan(28, 4), 2);
    if (surface == TeapotSurface::closed) {
        mesh.add_gap(lid, body);
        for (const detail::TeapotPart& tube : {handle, spout})
            for (const bool last : {false, true}) mesh.add_cover(tube, last);
    }
    return mesh.take();
}

}  // namespace pellucid::inline v0_1
