// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Newell's teapot, as the bicubic Bézier patches that it was made of and as a mesh.
///
/// M. E. Newell, "The Utilization of Procedure Models in Digital Image Synthesis", PhD thesis, University of Utah,
/// 1975; F. Crow, "The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987.  Newell's 28 patches
/// have no bottom; its four came later.  The units are the data set's, taken as metres; y is up, the axis of the body
/// is the y axis, the bottom stands on y = 0, the spout points to +x and the handle to -x.  The teapot reaches from -3
/// to 3.434 in x (spout's lip), from 0 to 3.15 in y (knob) and from -2 to 2 in z.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/mesh.hpp>
#include <cstdint>
#include <vector>

namespace pellucid::inline v0_1 {

/// `P(s, t)` = sum over i, j of B_i(t) B_j(s) `points[i][j]`, s and t in [0,1], B the cubic Bernstein polynomials.
struct BezierPatch {
    glm::dvec3 points[4][4];
};

/// How much of a teapot.
enum class TeapotSurface : std::uint8_t {
    original,     ///< the 28 patches of 1975: lid, body with its rim, handle, spout
    with_bottom,  ///< and the four of the bottom: what is drawn most often
    closed  ///< and flat covers over what is open even then: the gap between lid and rim, both ends of the handle,
            ///< which are inside the body's wall, the spout's end in the body, and its mouth
};

/// The control points: 28 patches, or 32.  Seen from outside, s runs to the right and t down or along the tube, so that
/// dP/dt x dP/ds points outward.  In order: lid (two rows of four patches round the axis), body (three rows, the first
/// one is the rim), bottom (one row) if there is one, handle (two rows, from the top down, of two patches round the
/// tube), spout (two rows, from the body outward).  Columns of the first three begin at -x and go over +z to +x, those
/// of the tubes begin on the inner side of the bend and go over -z.
[[nodiscard]] std::vector<BezierPatch> teapot_patches(bool bottom = true);

/// The patches cut into `divisions` x `divisions` quads each, 2 <= divisions <= 1024, with the normals of the exact
/// surface: the cross product of the partial derivatives, and its limit where one of them vanishes (the tip of the knob
/// and the middle of the bottom).  Counter-clockwise from outside.  u runs once round the part with s, v from the first
/// to the last row of its patches with t; lid, body, bottom, handle and spout (and each cover) have the whole picture.
///
/// Triangles, n = divisions: 56 n² - 4 n (original), 64 n² - 8 n (with bottom), 64 n² + 8 n - 8 (closed); none is
/// degenerate, and from six divisions on each faces as the normals at its corners do (with fewer, knob and spout's lip
/// are too round for that).  Parts that meet have the same positions there, bit by bit.  A `closed` teapot is three
/// closed manifolds (lid with body and bottom; handle; spout), the second and third of which pierce the first, as in
/// Newell's model; else an edge that two triangles do not share is on one of the openings that `TeapotSurface` names.
[[nodiscard]] Mesh make_teapot(std::uint32_t divisions, TeapotSurface surface = TeapotSurface::with_bottom);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/teapot-inl.hpp>
#endif
