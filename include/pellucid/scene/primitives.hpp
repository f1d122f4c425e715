// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Simple closed and flat meshes with normals and texture coordinates, counter-clockwise from outside, centred on the
/// origin.  v runs down the picture, as in glTF; no tangents (`make_tangents` adds them).
#include <pellucid/core/config.hpp>
#include <pellucid/scene/mesh.hpp>
#include <cstdint>

namespace pellucid {

/// Latitude-longitude sphere: `rings` >= 2 bands from pole to pole, `segments` >= 3 around; u goes round from -x over
/// +z to +x, v from the north pole (+y) to the south pole.  2 segments (rings - 1) triangles; the seam is doubled.
[[nodiscard]] Mesh make_uv_sphere(float radius, std::uint32_t rings, std::uint32_t segments);

/// Icosahedron with every triangle split in four `subdivisions` (<= 8) times: 20 · 4^n triangles of nearly one size,
/// 10 · 4^n + 2 vertices; no texture coordinates.
[[nodiscard]] Mesh make_icosphere(float radius, std::uint32_t subdivisions);

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

}  // namespace pellucid

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/primitives-inl.hpp>
#endif
