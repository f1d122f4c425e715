// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// CPU scene → the structs of gpu/scene.h.  Pure functions; no device.
#include <pellucid/gpu/scene.h>
#include <pellucid/scene/scene.hpp>
#include <pellucid/scene/texture_plan.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace pellucid::inline v0_1 {

/// Where each mesh lies in the shared vertex and index buffers.
struct MeshPlacement {
    std::vector<std::uint32_t> first_vertex, first_index;
    std::uint64_t vertices = 0, indices = 0;
    /// Where `append_reversed_triangles` puts the triangles of an index range.
    [[nodiscard]] std::uint32_t reversed_index(std::uint32_t first, std::uint32_t count) const {
        return static_cast<std::uint32_t>(2 * indices - first - count);
    }
};

/// Appends all triangles once more, the last one first; the corners of each keep their order.
inline void append_reversed_triangles(std::vector<std::uint32_t>& indices) {
    const std::size_t count = indices.size();
    indices.resize(2 * count);
    for (std::size_t t = 0; t < count; t += 3)
        std::copy_n(indices.begin() + static_cast<std::ptrdiff_t>(count - t - 3), 3,
                    indices.begin() + static_cast<std::ptrdiff_t>(count + t));
}

/// Rounded to single precision.
[[nodiscard]] inline gpu::vec3 to_gpu(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// The same value in the shared struct's type.
[[nodiscard]] inline gpu::vec3 to_gpu(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// Four values in [0,1] → 4 × unorm16, rounded to nearest; k/255 is exact.
[[nodiscard]] inline gpu::uvec2 pack_color(const glm::vec4& c) {
    auto code = [](float v) { return static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 65535.0f)); };
    return {code(c.x) | code(c.y) << 16u, code(c.z) | code(c.w) << 16u};
}

/// Where each mesh lies in the scene's one vertex and one index buffer.
[[nodiscard]] inline MeshPlacement place_meshes(const Scene& scene) {
    MeshPlacement p;
    for (const Mesh& mesh : scene.meshes) {
        p.first_vertex.push_back(static_cast<std::uint32_t>(p.vertices));
        p.first_index.push_back(static_cast<std::uint32_t>(p.indices));
        p.vertices += mesh.positions.size();
        p.indices += mesh.indices.size();
    }
    return p;
}

/// The vertices of all meshes, one after the other.
[[nodiscard]] inline std::vector<gpu::Vertex> gpu_vertices(const Scene& scene) {
    std::vector<gpu::Vertex> out;
    for (const Mesh& mesh : scene.meshes) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            gpu::Vertex v{};
            v.position = to_gpu(mesh.positions[i]);
            v.normal = to_gpu(mesh.normals[i]);
            if (!mesh.tangents.empty())
                v.tangent = {mesh.tangents[i].x, mesh.tangents[i].y, mesh.tangents[i].z, mesh.tangents[i].w};
            if (!mesh.uv0.empty()) v.u0 = mesh.uv0[i].x, v.v0 = mesh.uv0[i].y;
            if (!mesh.uv1.empty()) v.uv1 = {mesh.uv1[i].x, mesh.uv1[i].y};
            v.color = pack_color(mesh.colors.empty() ? glm::vec4(1) : mesh.colors[i]);
            out.push_back(v);
        }
    }
    return out;
}

/// KHR_texture_transform as a matrix: uv' = T R S uv, with R turning counter-clockwise in texture space.
[[nodiscard]] inline gpu::TextureUse gpu_texture_use(const TextureRef& ref,
                                                     const std::vector<TexturePlan::Place>& places) {
    gpu::TextureUse use{};
    if (!ref.used() || places[ref.texture].array == no_index) return use;
    const double c = std::cos(static_cast<double>(ref.rotation)), s = std::sin(static_cast<double>(ref.rotation));
    use.matrix = {static_cast<float>(c * ref.scale.x), static_cast<float>(s * ref.scale.y),
                  static_cast<float>(-s * ref.scale.x), static_cast<float>(c * ref.scale.y)};
    use.offset = {ref.offset.x, ref.offset.y};
    const TexturePlan::Place place = places[ref.texture];
    use.place = (place.array + 1u) | place.layer << 8u | ref.uv_set << 24u;
    return use;
}

/// A material with its textures' places in the arrays.
[[nodiscard]] inline gpu::MaterialRecord gpu_material(const Material& m, const TexturePlan& plan) {
    gpu::MaterialRecord r{};
    r.base_color = {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w};
    r.emissive = to_gpu(m.emissive);
    r.alpha_cutoff = m.alpha_cutoff;
    r.metallic = m.metallic;
    r.roughness = m.roughness;
    r.normal_scale = m.normal_scale;
    r.occlusion_strength = m.occlusion_strength;
    r.flags = (m.double_sided ? PELLUCID_MATERIAL_DOUBLE_SIDED : 0u) | (m.unlit ? PELLUCID_MATERIAL_UNLIT : 0u) |
              (m.alpha_mode == AlphaMode::mask ? PELLUCID_MATERIAL_MASK : 0u) |
              (m.alpha_mode == AlphaMode::blend ? PELLUCID_MATERIAL_BLEND : 0u) |
              (m.premultiplied ? PELLUCID_MATERIAL_PREMULTIPLIED : 0u);
    r.base_color_texture = gpu_texture_use(m.base_color_texture, plan.as_color);
    r.metallic_roughness_texture = gpu_texture_use(m.metallic_roughness_texture, plan.as_data);
    r.normal_texture = gpu_texture_use(m.normal_texture, plan.as_data);
    r.occlusion_texture = gpu_texture_use(m.occlusion_texture, plan.as_data);
    r.emissive_texture = gpu_texture_use(m.emissive_texture, plan.as_color);
    return r;
}

/// A light in view space; cone terms are computed in double so that narrow cones keep their axis intensity
/// (cos i - cos o = 2 sin((o+i)/2) sin((o-i)/2)).
[[nodiscard]] inline gpu::LightRecord gpu_light(const Light& light, const glm::dmat4& view_from_world) {
    gpu::LightRecord r{};
    r.position = to_gpu(glm::dvec3(view_from_world * glm::dvec4(light.position, 1)));
    r.to_light = to_gpu(glm::dvec3(view_from_world * glm::dvec4(-light.direction, 0)));
    r.intensity = to_gpu(light.color * light.intensity);
    r.inverse_range_squared = light.range > 0 ? 1.0f / (light.range * light.range) : 0.0f;
    if (light.kind == LightKind::spot) {
        const double i = light.inner_cone, o = light.outer_cone;
        const double width = 2.0 * std::sin(0.5 * (o + i)) * std::sin(0.5 * (o - i));
        r.spot_scale = static_cast<float>(1.0 / std::max(width, 1e-12));
        r.spot_edge = static_cast<float>(2.0 * std::sin(0.5 * o) * std::sin(0.5 * o));
    }
    return r;
}

/// Centre (view space) and radius [m] of a sphere around all that a point or spot light reaches, a ten-thousandth
/// larger than it is, so that no rounding leaves a pixel out; 1e30 for one without a range.
[[nodiscard]] inline gpu::vec4 gpu_light_bounds(const Light& light, const glm::dmat4& view_from_world) {
    glm::dvec3 center = light.position;
    double radius = light.range;
    if (!reaches_an_end(light)) {
        radius = 1e30;
    } else if (light.kind == LightKind::spot) {
        // The circle through the tip and the rim of a narrow cone's cap; around the rim of a wide one.
        const double c = std::cos(light.outer_cone);
        const bool narrow = c * c > 0.5;
        const double along = narrow ? 0.5 * radius / c : radius * c;
        radius = narrow ? along : radius * std::sin(light.outer_cone);
        center += along * light.direction;
    }
    const gpu::vec3 e = to_gpu(glm::dvec3(view_from_world * glm::dvec4(center, 1)));
    const double grown = 1.0001 * radius + 1e-6 * (std::abs(e.x) + std::abs(e.y) + std::abs(e.z));
    return {e.x, e.y, e.z, static_cast<float>(grown)};
}

/// Writes an instance's matrices and mirroring into `r`.  The normal matrix is scaled so that its largest element is 1.
inline void place(gpu::DrawRecord& r, const glm::dmat4& view_from_object) {
    const glm::dmat3 m(view_from_object);
    const double determinant = glm::determinant(m);
    // cof(M) = det(M) M^-T exists for singular matrices too; the sign of det makes it point like M^-T.
    glm::dmat3 n(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(n[c][row]));
    if (largest > 0) n *= (determinant < 0 ? -1.0 : 1.0) / largest;
    r.origin = to_gpu(glm::dvec3(view_from_object[3]));
    r.axis_x = to_gpu(m[0]);
    r.axis_y = to_gpu(m[1]);
    r.axis_z = to_gpu(m[2]);
    r.normal_x = to_gpu(n[0]);
    r.normal_y = to_gpu(n[1]);
    r.normal_z = to_gpu(n[2]);
    r.flags = (r.flags & ~PELLUCID_DRAW_MIRRORED) | (determinant < 0 ? PELLUCID_DRAW_MIRRORED : 0u);
}

}  // namespace pellucid::inline v0_1
