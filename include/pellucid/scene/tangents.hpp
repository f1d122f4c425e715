// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Tangent frames for normal mapping, derived from positions, normals and texture coordinates.
///
/// Each triangle has a direction of growing u on its surface and a handedness.  A vertex gets the sum of the directions
/// of its triangles, each made orthogonal to the vertex's normal, of unit length, and weighted by the triangle's angle
/// there (measured orthogonal to the normal).  Corners that share position, normal and texture coordinate are one
/// vertex, whatever their indices; corners of unlike handedness never are, and neither are corners whose triangles
/// touch only in that point (a fan that is not joined by edges).  Where the result differs for one index, the vertex is
/// doubled.
///
/// The result agrees with MikkTSpace in these rules, with glTF's sign: the bitangent w cross(normal, tangent) points up
/// the picture, to falling v.  It differs where texture coordinates are degenerate: MikkTSpace
/// lends such a triangle the frame of a neighbour; here it adds nothing, and a vertex with degenerate triangles alone
/// gets some unit tangent orthogonal to its normal.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/mesh.hpp>
#include <vector>

namespace pellucid::inline v0_1 {

/// Fills `mesh.tangents` from `uv`, which has one value a vertex (`mesh.uv0` or `mesh.uv1`, or transformed ones).
/// May append vertices (all attributes follow) and change indices; the number and order of triangles stay.  Every
/// tangent is finite, unit and orthogonal to its normal to float precision, w = ±1.
void make_tangents(Mesh& mesh, const std::vector<glm::vec2>& uv);

/// The same from `mesh.uv0`; precondition: it is not empty.
void make_tangents(Mesh& mesh);

/// A unit vector orthogonal to the unit vector `normal`.
[[nodiscard]] glm::vec3 any_tangent(glm::vec3 normal);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/tangents-inl.hpp>
#endif
