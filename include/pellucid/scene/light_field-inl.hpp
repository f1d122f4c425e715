// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of light_field.hpp.
#include <pellucid/scene/detail/sample_parts.hpp>
#include <pellucid/scene/light_field.hpp>

namespace pellucid::inline v0_1 {

PELLUCID_INLINE Scene make_light_field(const LightField& field) {
    constexpr double side = 40;  // [m]
    detail::SceneBuilder builder;
    detail::SampleRandom random(field.seed);
    const auto material = [&](glm::vec3 color, float metallic, float roughness, const char* name) {
        return builder.add_material(
            {.base_color = {color, 1}, .metallic = metallic, .roughness = roughness, .name = name});
    };
    builder.place(builder.add_mesh(make_plane(side, side), material({0.5f, 0.5f, 0.5f}, 0, 0.45f, "floor"), "floor"));
    const std::uint32_t pillar =
        builder.add_mesh(make_box({0.9f, 2.4f, 0.9f}), material({0.62f, 0.6f, 0.56f}, 0, 0.7f, "plaster"), "pillar");
    const std::uint32_t ball =
        builder.add_mesh(make_uv_sphere(0.6f, 24, 48), material({0.95f, 0.8f, 0.5f}, 1, 0.35f, "brass"), "ball");
    const std::uint32_t pane = builder.add_mesh(
        detail::make_pane(2.2, 1.8),
        builder.add_material(detail::glass_material({0.25f, 0.55f, 0.7f, 0.4f}, 0.3f, "glass")), "pane");
    constexpr int count = 8;
    for (int row = 0; row < count; ++row)
        for (int column = 0; column < count; ++column) {
            const glm::dvec3 at((column + 0.5) * side / count - side / 2, 0, (row + 0.5) * side / count - side / 2);
            if ((row + column) % 2 == 0)
                builder.place(pillar, at + glm::dvec3(0, 1.2, 0), 0.3 * row);
            else
                builder.place(ball, at + glm::dvec3(0, 0.6, 0));
            if (field.panes && (row + 2 * column) % 3 == 0)
                builder.place(pane, at + glm::dvec3(1.6, 1, 1.3), 0.4 * column);
        }
    const double range = std::sqrt(field.overlap * side * side / (detail::sample_pi * std::max(1u, field.lights)));
    const double height = 0.35 * range;
    for (std::uint32_t i = 0; i < field.lights; ++i) {
        const double x = random.between(-side / 2, side / 2), z = random.between(-side / 2, side / 2);
        const glm::dvec3 color = 0.15 + 0.85 * detail::hue_color(random.between(0, 1));
        const bool spot = i % 4 == 3;
        builder.scene.lights.push_back({.kind = spot ? LightKind::spot : LightKind::point,
                                        .color = glm::vec3(color),
                                        .intensity = static_cast<float>((spot ? 4 : 2) * height * height),
                                        .range = static_cast<float>(range),
                                        .inner_cone = 0.5,
                                        .outer_cone = 0.9,
                                        .position = {x, height, z},
                                        .direction = {0, -1, 0},
                                        .name = "light " + std::to_string(i)});
    }
    builder.scene.cameras.push_back(detail::sample_camera({3, 7.5, 23}, {0, 0, 2}, 0.85));
    return std::move(builder.scene);
}

}  // namespace pellucid::inline v0_1
