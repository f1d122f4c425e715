// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// From a mesh, its placement and its material to the surface at a point of a triangle, in world space and in double.
///
/// Per vertex: the position and tangent by the instance's matrix, the normal by its inverse transpose, both directions
/// made unit, and the tangent's handedness turned where the instance is mirrored.  All attributes are interpolated with
/// perspective-correct weights; normals are made unit once, after the normal map.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/raster.hpp>
#include <pellucid/reference/texture.hpp>
#include <pellucid/scene/scene.hpp>

namespace pellucid::inline v0_1::reference {

/// An instance's matrix and what follows from it.
struct Placement {
    glm::dmat4 world_from_object{1.0};
    glm::dmat3 normal_from_object{1.0};  ///< cofactors with the determinant's sign: like the inverse transpose, up to a
                                         ///< positive factor, and there for flattening matrices too
    bool mirrored = false;               ///< negative determinant: triangles turn round, front faces are clockwise
};
[[nodiscard]] inline Placement placement(const glm::dmat4& world_from_object) noexcept;

/// What is interpolated over a triangle.
struct Attributes {
    glm::dvec3 position{0};  ///< [m] world
    glm::dvec3 normal{0};    ///< world; unit at vertices
    glm::dvec4 tangent{0};   ///< world; unit at vertices, 0 where the mesh has none; w: handedness
    glm::dvec2 uv[2] = {};   ///< texture coordinates of both sets, 0 where the mesh has none
    glm::dvec4 color{1};     ///< linear straight RGBA
};
[[nodiscard]] inline Attributes vertex_attributes(const Mesh& mesh, const Placement& placed,
                                                  std::uint32_t vertex) noexcept;
[[nodiscard]] inline Attributes interpolated(const Attributes (&corners)[3], const glm::dvec3& weights) noexcept;

/// Change of texture coordinates from one pixel to the next, right and down.
struct UvDerivatives {
    glm::dvec2 dx[2] = {}, dy[2] = {};  ///< of both sets
};

/// A texture as a material uses it.
struct TextureUse {
    const SampledTexture* texture = nullptr;  ///< null: none
    TextureRef ref;                           ///< coordinate set and KHR_texture_transform
};

/// A material with its textures at hand.
struct TexturedMaterial {
    Material factors;
    TextureUse base_color, metallic_roughness, normal, occlusion, emissive;
};

/// KHR_texture_transform: scaled, then turned by `rotation`, counter-clockwise on the picture as it is looked at (v
/// runs down): u' = cos·u + sin·v, v' = −sin·u + cos·v; then moved by `offset`.
[[nodiscard]] inline glm::dvec2 transformed_uv(const TextureRef& ref, glm::dvec2 uv) noexcept;

/// The texture's value in linear light, or all ones where there is none.
[[nodiscard]] inline glm::dvec4 sample_use(const TextureUse& use, const Attributes& at,
                                           const UvDerivatives& change) noexcept;

/// Base colour factor · texture · vertex colour: linear, straight alpha.
[[nodiscard]] inline glm::dvec4 base_color(const TexturedMaterial& material, const Attributes& at,
                                           const UvDerivatives& change) noexcept {
    return glm::dvec4(material.factors.base_color) * sample_use(material.base_color, at, change) * at.color;
}

/// Whether a fragment with this alpha of its base colour is there: a masked one is from the cutoff on.
[[nodiscard]] inline bool passes_mask(const Material& material, double alpha) noexcept {
    return material.alpha_mode != AlphaMode::mask || alpha >= static_cast<double>(material.alpha_cutoff);
}

/// Share of what lies behind that the fragment hides, in [0,1]: 1 for opaque and masked materials.
[[nodiscard]] inline double fragment_alpha(const Material& material, double alpha) noexcept {
    return material.alpha_mode == AlphaMode::blend ? std::clamp(alpha, 0.0, 1.0) : 1.0;
}

/// The shading normal, unit: normal map in glTF's convention (texel · 2 − 1, x and y times `normal_scale`, bitangent =
/// w cross(normal, tangent)); turned round on back faces.  Where interpolation leaves no direction, `fallback` (unit).
[[nodiscard]] inline glm::dvec3 shading_normal(const TexturedMaterial& material, const Attributes& at,
                                               const UvDerivatives& change, bool front,
                                               const glm::dvec3& fallback) noexcept;

/// What reflects and shines at a point: metallic and roughness are the factors times blue and green, in [0,1];
/// occlusion is 1 + strength (red − 1); emissive is the factor times the texture.
[[nodiscard]] inline Surface<double> surface_at(const TexturedMaterial& material, const Attributes& at,
                                                const UvDerivatives& change, bool front,
                                                const glm::dvec3& fallback_normal) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// `v` with length 1, or `otherwise` where it has next to none.
[[nodiscard]] inline glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) noexcept {
    const double length2 = glm::dot(v, v);
    return length2 > 1e-30 && std::isfinite(length2) ? v / std::sqrt(length2) : otherwise;
}

}  // namespace detail

/// The placement of an instance.
Placement placement(const glm::dmat4& world_from_object) noexcept {
    const glm::dmat3 m(world_from_object);
    const bool mirrored = glm::determinant(m) < 0;
    const double sign = mirrored ? -1.0 : 1.0;
    const glm::dvec3 columns[] = {sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                                  sign * glm::cross(m[0], m[1])};
    double largest = 0;  // a common factor: small scales would leave the range that counts as a direction
    for (const glm::dvec3& c : columns)
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(c[i]));
    const double scale = largest > 0 ? 1 / largest : 1.0;
    return {world_from_object, glm::dmat3(columns[0] * scale, columns[1] * scale, columns[2] * scale), mirrored};
}

/// The attributes of one vertex, placed in the world.
Attributes vertex_attributes(const Mesh& mesh, const Placement& placed, std::uint32_t vertex) noexcept {
    Attributes out;
    out.position = glm::dvec3(placed.world_from_object * glm::dvec4(mesh.positions[vertex], 1.0));
    out.normal = detail::unit_or(placed.normal_from_object * glm::dvec3(mesh.normals[vertex]), glm::dvec3(0));
    if (!mesh.tangents.empty()) {
        const glm::dvec4 tangent(mesh.tangents[vertex]);
        const glm::dvec3 turned = glm::dmat3(placed.world_from_object) * glm::dvec3(tangent);
        out.tangent = glm::dvec4(detail::unit_or(turned, glm::dvec3(0)), placed.mirrored ? -tangent.w : tangent.w);
    }
    if (!mesh.uv0.empty()) out.uv[0] = glm::dvec2(mesh.uv0[vertex]);
    if (!mesh.uv1.empty()) out.uv[1] = glm::dvec2(mesh.uv1[vertex]);
    if (!mesh.colors.empty()) out.color = glm::dvec4(mesh.colors[vertex]);
    return out;
}

/// The attributes of a point of a triangle.
Attributes interpolated(const Attributes (&corners)[3], const glm::dvec3& weights) noexcept {
    const Attributes &a = corners[0], &b = corners[1], &c = corners[2];
    return {mixed(a.position, b.position, c.position, weights),
            mixed(a.normal, b.normal, c.normal, weights),
            mixed(a.tangent, b.tangent, c.tangent, weights),
            {mixed(a.uv[0], b.uv[0], c.uv[0], weights), mixed(a.uv[1], b.uv[1], c.uv[1], weights)},
            mixed(a.color, b.color, c.color, weights)};
}

glm::dvec2 transformed_uv(const TextureRef& ref, glm::dvec2 uv) noexcept {
    const double angle = ref.rotation, c = std::cos(angle), s = std::sin(angle);
    const glm::dvec2 scaled = uv * glm::dvec2(ref.scale);
    return glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x) + glm::dvec2(ref.offset);
}

glm::dvec4 sample_use(const TextureUse& use, const Attributes& at, const UvDerivatives& change) noexcept {
    if (!use.texture) return glm::dvec4(1.0);
    const std::uint32_t set = use.ref.uv_set;
    TextureRef linear = use.ref;  // derivatives are turned and scaled, not moved
    linear.offset = {0, 0};
    return sample(*use.texture, transformed_uv(use.ref, at.uv[set]), transformed_uv(linear, change.dx[set]),
                  transformed_uv(linear, change.dy[set]));
}

glm::dvec3 shading_normal(const TexturedMaterial& material, const Attributes& at, const UvDerivatives& change,
                          bool front, const glm::dvec3& fallback) noexcept {
    glm::dvec3 n = detail::unit_or(at.normal, fallback);
    if (material.normal.texture) {
        const glm::dvec3 texel = glm::dvec3(sample_use(material.normal, at, change)) * 2.0 - 1.0;
        const double scale = material.factors.normal_scale;
        const glm::dvec3 tangent(at.tangent), bitangent = at.tangent.w * glm::cross(at.normal, tangent);
        n = detail::unit_or(tangent * (texel.x * scale) + bitangent * (texel.y * scale) + at.normal * texel.z, n);
    }
    return front ? n : -n;
}

Surface<double> surface_at(const TexturedMaterial& material, const Attributes& at, const UvDerivatives& change,
                           bool front, const glm::dvec3& fallback_normal) noexcept {
    const Material& m = material.factors;
    const glm::dvec4 metallic_roughness = sample_use(material.metallic_roughness, at, change);
    Surface<double> s;
    s.base_color = glm::dvec3(base_color(material, at, change));
    s.metallic = std::clamp(m.metallic * metallic_roughness.b, 0.0, 1.0);
    s.roughness = std::clamp(m.roughness * metallic_roughness.g, 0.0, 1.0);
    s.occlusion = 1.0 + m.occlusion_strength * (sample_use(material.occlusion, at, change).r - 1.0);
    s.emissive = glm::dvec3(m.emissive) * glm::dvec3(sample_use(material.emissive, at, change));
    s.normal = shading_normal(material, at, change, front, fallback_normal);
    return s;
}

}  // namespace pellucid::inline v0_1::reference
