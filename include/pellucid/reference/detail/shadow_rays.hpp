// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Exact hard shadows: rays from a point to a light through the opaque and masked triangles of a scene.
#include <cmath>
#include <cstdint>
#include <pellucid/reference/detail/draws.hpp>
#include <vector>

namespace pellucid::inline v0_1::reference::detail {

/// The triangles that cast.
[[nodiscard]] inline TriangleTree caster_tree(const Prepared& prepared) {
    std::vector<TreeTriangle> triangles;
    for (std::uint32_t d = 0; d < prepared.draws.size(); ++d) {
        const Draw& draw = prepared.draws[d];
        if (draw.blended()) continue;
        for (std::uint32_t p = draw.first_primitive; p < draw.end_primitive; ++p) {
            TreeTriangle t{.corners = {}, .primitive = p, .draw = d};
            for (int i = 0; i < 3; ++i)
                t.corners[i] = glm::dvec3(draw.placed.world_from_object *
                                          glm::dvec4(draw.mesh->positions[draw.corners(p)[i]], 1.0));
            triangles.push_back(t);
        }
    }
    return TriangleTree(std::move(triangles));
}

/// Whether anything keeps `light`, which lies towards `to_light` (unit), from `position` on the triangle `own`.
[[nodiscard]] inline bool in_shadow(const Prepared& prepared, const glm::dvec3& position, std::uint32_t own,
                                    const Light& light, const glm::dvec3& to_light) {
    // A position is some roundings of its size off its plane, and neighbours in the same plane must not shadow it.
    const double size = std::abs(position.x) + std::abs(position.y) + std::abs(position.z);
    const double nearest = 1e-12 * (1 + size);
    const double farthest = light.kind == LightKind::directional ? std::numeric_limits<double>::infinity()
                                                                 : glm::distance(light.position, position);
    return prepared.casters.any(position, to_light, nearest, farthest, [&](const TreeTriangle& t, const RayHit& hit) {
        if (t.primitive == own) return false;
        const Draw& draw = prepared.draws[t.draw];
        const Material& material = draw.material->factors;
        // The ray leaves the surface: what it meets from behind has its front towards the light.
        const bool towards_light = hit.front == draw.placed.mirrored;
        if (!material.double_sided && !towards_light) return false;
        if (material.alpha_mode != AlphaMode::mask) return true;
        const std::uint32_t* at = draw.corners(t.primitive);
        const Attributes corners[3] = {vertex_attributes(*draw.mesh, draw.placed, at[0]),
                                       vertex_attributes(*draw.mesh, draw.placed, at[1]),
                                       vertex_attributes(*draw.mesh, draw.placed, at[2])};
        return passes_mask(material, base_color(*draw.material, interpolated(corners, hit.weights), {}).a);
    });
}

}  // namespace pellucid::inline v0_1::reference::detail
