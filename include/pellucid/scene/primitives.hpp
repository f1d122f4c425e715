// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Simple closed and flat meshes with normals and texture coordinates, counter-clockwise from outside, centred on the
/// origin.  v runs down the picture, as in glTF; no tangents (`make_tangents` adds them).
#include <pellucid/core/config.hpp>
#include <pellucid/scene/mesh.hpp>
#include <cstdint>

namespace pellucid::inline v0_1 {

/// Latitude-longitude sphere: `rings` >= 2 bands from pole to pole, `segments` >= 3 around; u goes round from -x over
/// +z to +x, v from the north pole (+y) to the south pole.  2 segments (rings - 1) triangles; the seam is doubled.
[[nodiscard]] Mesh make_uv_sphere(float radius, std::uint32_t rings, std::uint32_t segments);

/// Icosahedron with every triangle split in four `subdivisions` (<= 8) times: 20 · 4^n triangles of nearly one size,
/// 10 · 4^n + 2 vertices; no texture coordinates.
[[nodiscard]] Mesh make_icosphere(float radius, std::uint32_t subdivisions);

/// Torus round the y axis: a tube of radius `minor` > 0 whose centre line is a circle of radius `major` > `minor` [m];
/// `segments` >= 3 round the axis, `sides` >= 3 round the tube.  u goes round from -x over +z to +x, v round the tube
/// from its inner side over the top (+y) and down the outer side; both seams are doubled.  2 segments sides triangles,
/// a polyhedron of volume segments sin(2 pi / segments) · major · 1/2 sides minor² sin(2 pi / sides), whose limit is
/// 2 pi² major minor²: every vertex is on the torus, every face is flat.
[[nodiscard]] Mesh make_torus(float major, float minor, std::uint32_t segments, std::uint32_t sides);

/// Box with the given edge lengths [m]: 24 vertices, each face has the whole picture upright.
[[nodiscard]] Mesh make_box(glm::vec3 size);

/// Cube with the given edge length [m].
[[nodiscard]] inline Mesh make_cube(float size) {
    return make_box(glm::vec3(size));
}

/// Rectangle in the plane y = 0 facing +y; u along +x, v along +z, the picture repeated `tiles` times each way.
[[nodiscard]] Mesh make_plane(float size_x, float size_z, float tiles = 1);

/// Sets `mesh.lower` and `mesh.upper` from its positions.
void update_bounds(Mesh& mesh);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/primitives-inl.hpp>
#endif
