// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Scenes of the pass benchmarks: surfaces that cover every pixel, and spheres.  The camera stands at the origin.
#include <cmath>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/scene.hpp>

namespace pellucid::bench {

[[nodiscard]] inline Camera bench_camera() {
    return {.vertical_fov = 0.8, .near = 0.1};
}

/// A rectangle across the view at `distance` [m] that covers the whole picture and a fifth more.  The normals of its
/// corners lean outward by `lean` (tangent of the angle) and all of them by `tilt` too, so that they differ in every
/// pixel.
[[nodiscard]] inline Mesh make_view_quad(Extent2D size, double distance, double lean, glm::dvec2 tilt) {
    const Camera camera = bench_camera();
    const double half_height = 1.2 * distance * std::tan(0.5 * camera.vertical_fov);
    const double half_width = half_height * size.width / size.height;
    Mesh mesh;
    for (int corner = 0; corner < 4; ++corner) {
        const double sx = corner == 1 || corner == 2 ? 1 : -1, sy = corner >= 2 ? 1 : -1;
        mesh.positions.push_back(glm::vec3(glm::dvec3(sx * half_width, sy * half_height, -distance)));
        mesh.normals.push_back(glm::vec3(glm::normalize(glm::dvec3(lean * sx + tilt.x, lean * sy + tilt.y, 1))));
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    update_bounds(mesh);
    return mesh;
}

/// Adds an instance of a mesh of its own with a material of its own.
inline void add_object(Scene& scene, Mesh mesh, Material material) {
    mesh.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::move(mesh));
}

/// `count` opaque rectangles 0.5 m apart, the nearest 2 m away, drawn from the front or from the back.
[[nodiscard]] inline Scene make_opaque_layers(Extent2D size, std::uint32_t count, bool front_to_back) {
    Scene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t layer = front_to_back ? i : count - 1 - i;
        add_object(scene, make_view_quad(size, 2.0 + 0.5 * layer, 0.8, {0.1 * layer, -0.05 * layer}),
                   {.base_color = {0.11f + 0.2f * static_cast<float>(layer), 0.5f, 0.83f, 1},
                    .metallic = 0.31f,
                    .roughness = 0.123f + 0.1f * static_cast<float>(layer)});
    }
    return scene;
}

/// 10 x 10 spheres that fill the height of the view, 4 m away; ten materials.
[[nodiscard]] inline Scene make_sphere_field(std::uint32_t rings) {
    const double spacing = 2.0 * 4.0 * std::tan(0.5 * bench_camera().vertical_fov) / 10;
    Scene scene;
    for (std::uint32_t i = 0; i < 10; ++i) {
        Mesh mesh = make_uv_sphere(static_cast<float>(0.49 * spacing), rings, 2 * rings);
        mesh.material = i;
        scene.meshes.push_back(std::move(mesh));
        const float t = static_cast<float>(i) / 9.0f;
        scene.materials.push_back({.base_color = {0.05f + 0.9f * t, 0.6f - 0.5f * t, 0.37f, 1},
                                   .metallic = t,
                                   .roughness = 0.04f + 0.95f * t});
    }
    for (std::uint32_t i = 0; i < 100; ++i) {
        Instance instance{.mesh = i % 10};
        instance.world_from_object[3] = glm::dvec4((i % 10 - 4.5) * spacing, (i / 10 - 4.5) * spacing, -4, 1);
        scene.instances.push_back(instance);
    }
    return scene;
}

/// `count` point lights (or suns) on the eye's side of a rectangle 2 m away, each of them above the horizon of every
/// pixel; together they give about 1 lx·sr for any count.
inline void add_lights(Scene& scene, LightKind kind, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.39996322972865332 * i, radius = 0.8 * std::sqrt((i + 0.5) / count);  // a sunflower
        const glm::dvec3 position(radius * std::cos(angle), radius * std::sin(angle), 1.0 + 0.3 * std::sin(7.0 * i));
        const float share = 1.0f / static_cast<float>(count);
        scene.lights.push_back({.kind = kind,
                                .color = {1.0f, 0.9f - 0.1f * static_cast<float>(i % 3), 0.8f},
                                .intensity = share * (kind == LightKind::point ? 25.0f : 3.0f),
                                .position = position,
                                .direction = -glm::normalize(position + glm::dvec3(0, 0, 2))});
    }
}

}  // namespace pellucid::bench
