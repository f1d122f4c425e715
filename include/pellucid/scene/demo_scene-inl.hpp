// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of demo_scene.hpp.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/detail/scene_builder.hpp>
#include <pellucid/scene/primitives.hpp>

namespace pellucid::inline v0_1 {

PELLUCID_INLINE Scene make_demo_scene() {
    detail::SceneBuilder builder;
    const std::uint32_t stone = builder.add_material(
        {.base_color = {0.30f, 0.31f, 0.34f, 1}, .metallic = 0, .roughness = 0.55f, .name = "floor"});
    const std::uint32_t plaster = builder.add_material(
        {.base_color = {0.20f, 0.21f, 0.24f, 1}, .metallic = 0, .roughness = 0.9f, .name = "wall"});
    builder.place(builder.add_mesh(make_plane(24, 16, 12), stone, "floor"), {0, 0, 3});
    builder.place(builder.add_mesh(make_box({24, 9, 0.2f}), plaster, "wall"), {0, 4.5, -3.1});

    constexpr double spacing = 1.1;
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 5; ++column) {
            const float metallic = static_cast<float>(row) / 4.0f;
            const float roughness = 0.05f + 0.95f * static_cast<float>(column) / 4.0f;
            const std::string name = "sphere " + std::to_string(row) + " " + std::to_string(column);
            const std::uint32_t material = builder.add_material(
                {.base_color = {0.93f, 0.62f, 0.30f, 1}, .metallic = metallic, .roughness = roughness, .name = name});
            builder.place(builder.add_mesh(make_uv_sphere(0.47f, 32, 64), material, name),
                          {(column - 2) * spacing, 0.55 + row * spacing, 0});
        }

    const std::uint32_t blue = builder.add_material({.base_color = {0.08f, 0.32f, 0.92f, 0.4f},
                                                     .metallic = 0,
                                                     .roughness = 0.15f,
                                                     .alpha_mode = AlphaMode::blend,
                                                     .double_sided = true,
                                                     .name = "glass, alpha 0.4"});
    const std::uint32_t amber = builder.add_material({.base_color = {0.95f, 0.24f, 0.06f, 0.6f},
                                                      .metallic = 0,
                                                      .roughness = 0.25f,
                                                      .alpha_mode = AlphaMode::blend,
                                                      .double_sided = true,
                                                      .name = "glass, alpha 0.6"});
    builder.place(builder.add_mesh(make_cube(1.9f), blue, "cube, alpha 0.4"), {0.75, 0.96, 2.1}, 0.5);
    builder.place(builder.add_mesh(make_cube(1.5f), amber, "cube, alpha 0.6"), {2.35, 0.76, 1.9}, -0.25);

    struct Lamp {
        glm::vec3 color;
        float intensity;  // [cd]
        glm::dvec3 position;
    };
    constexpr Lamp lamps[] = {
        {{1.00f, 0.93f, 0.84f}, 40, {-3.2, 6.4, 4.6}}, {{0.80f, 0.90f, 1.00f}, 30, {4.2, 6.2, 4.2}},
        {{1.00f, 0.22f, 0.15f}, 16, {-4.1, 1.2, 2.2}}, {{1.00f, 0.60f, 0.15f}, 9, {-1.7, 3.3, 3.0}},
        {{0.20f, 1.00f, 0.40f}, 12, {-3.9, 4.4, 1.2}}, {{0.15f, 0.72f, 1.00f}, 14, {4.0, 3.8, 1.4}},
        {{0.28f, 0.30f, 1.00f}, 20, {4.4, 1.0, 2.6}},  {{1.00f, 0.25f, 0.80f}, 12, {0.2, 6.6, 1.4}}};
    for (std::size_t i = 0; i < std::size(lamps); ++i)
        builder.scene.lights.push_back({.color = lamps[i].color,
                                        .intensity = lamps[i].intensity,
                                        .position = lamps[i].position,
                                        .name = "lamp " + std::to_string(i)});

    Camera camera{.vertical_fov = 0.62, .near = 0.1, .name = "camera"};
    camera.world_from_view = look_at({2.6, 3.2, 11.4}, {0.75, 2.2, 0});
    builder.scene.cameras.push_back(camera);
    return std::move(builder.scene);
}

}  // namespace pellucid::inline v0_1
