// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of sample_scenes.hpp.
#include <pellucid/scene/detail/sample_parts.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <pellucid/scene/teapot.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace pellucid::inline v0_1 {
PELLUCID_INLINE Scene make_peeling_scene() {
    detail::SceneBuilder builder;
    const std::uint32_t amber =
        builder.add_material(detail::glass_material({0.95f, 0.42f, 0.06f, 0.5f}, 0.3f, "amber"));
    const std::uint32_t blue = builder.add_material(detail::glass_material({0.10f, 0.28f, 0.90f, 0.4f}, 0.5f, "blue"));
    const std::uint32_t green =
        builder.add_material(detail::glass_material({0.12f, 0.75f, 0.25f, 0.6f}, 0.4f, "green"));
    builder.place(builder.add_mesh(make_teapot(16), amber, "teapot"), {0, 0, 0}, 0.35);
    builder.place(builder.add_mesh(detail::make_pane(5.0, 4.2), blue, "pane"),
                  detail::pane_frame({0.1, 1.7, 0}, {-0.75, 0.25, 1}, {1, 0, 0.75}));
    builder.place(builder.add_mesh(make_uv_sphere(1.15f, 32, 64), green, "sphere"), {1.45, 1.05, 0.75});
    builder.scene.lights.push_back({.kind = LightKind::directional,
                                    .color = {1, 0.97f, 0.92f},
                                    .intensity = 4,
                                    .direction = glm::normalize(glm::dvec3(-0.35, -0.75, -0.8)),
                                    .name = "sun"});
    builder.scene.cameras.push_back(detail::sample_camera({1.9, 4.4, 11.2}, {0.15, 1.5, 0}, 0.58));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_linked_chain(std::uint32_t links) {
    assert(links >= 6);
    constexpr double major = 1, minor = 0.15, spacing = 1.35;
    const double step = 2 * detail::sample_pi / links, radius = spacing / (2 * std::sin(0.5 * step));
    // A quarter turn from link to link, or as near to it as closes the necklace.
    const double roll_step = detail::sample_pi * static_cast<double>((links + 1) / 2) / links;
    detail::SceneBuilder builder;
    const Mesh torus = make_torus(static_cast<float>(major), static_cast<float>(minor), 96, 32);
    for (std::uint32_t i = 0; i < links; ++i) {
        const std::string name = "link " + std::to_string(i);
        const double angle = i * step, roll = 0.25 * detail::sample_pi + i * roll_step;
        const glm::dvec3 outward(std::sin(angle), std::cos(angle), 0), along(outward.y, -outward.x, 0);
        const glm::dvec3 axis = std::cos(roll) * outward + std::sin(roll) * glm::dvec3(0, 0, 1);
        // The torus's own axis is y.
        const glm::dmat4 world(glm::dvec4(along, 0), glm::dvec4(axis, 0), glm::dvec4(glm::cross(along, axis), 0),
                               glm::dvec4(radius * outward, 1));
        const glm::dvec3 color = 0.06 + 0.88 * detail::hue_color(static_cast<double>(i) / links);
        builder.place(builder.add_mesh(torus, builder.add_material(detail::unlit_material({color, 0.5}, name)), name),
                      world);
    }
    const glm::dvec3 extent(radius + major + minor, radius + major + minor, major);
    builder.scene.cameras.push_back(detail::sample_camera_around(-extent, extent, {0.12, 0.1, 1}, 0.62));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_intersecting_planes(float alpha) {
    assert(alpha > 0 && alpha < 1);
    detail::SceneBuilder builder;
    Mesh cube = make_cube(1.1f);
    cube.uv0.clear();
    for (std::size_t v = 0; v < cube.normals.size(); ++v) {  // a shade a pair of faces: nothing else shows them apart
        const glm::vec3 n = glm::abs(cube.normals[v]);
        cube.colors.push_back(glm::vec4(glm::vec3(0.30f * n.x + 0.72f * n.y + 0.45f * n.z), 1));
    }
    const std::uint32_t white = builder.add_material(detail::unlit_material({1, 1, 1, 1}, "cube"));
    builder.place(builder.add_mesh(std::move(cube), white, "cube"), {0, 0, 0}, 0.5);
    const glm::dvec3 x = glm::normalize(glm::dvec3(1, 0.1, -0.06)), near_y(-0.1, 1, 0.08);
    const glm::dvec3 y = glm::normalize(near_y - x * glm::dot(x, near_y));
    const glm::dvec3 axes[] = {x, y, glm::cross(x, y)};
    const glm::dvec3 colors[] = {{0.95, 0.10, 0.08}, {0.10, 0.75, 0.12}, {0.10, 0.22, 0.95}};
    const char* const names[] = {"red", "green", "blue"};
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t material = builder.add_material(detail::unlit_material({colors[i], alpha}, names[i]));
        builder.place(builder.add_mesh(detail::make_pane(3, 3), material, names[i]),
                      detail::pane_frame({0, 0, 0}, axes[i], axes[(i + 1) % 3]));
    }
    builder.scene.cameras.push_back(detail::sample_camera({3.7, 3.0, 5.2}, {0, 0, 0}, 0.6));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_random_quads(std::uint32_t count, std::uint32_t seed) {
    detail::SceneBuilder builder;
    const std::uint32_t ground = builder.add_material(detail::unlit_material({0.18, 0.19, 0.22, 1}, "floor"));
    builder.place(builder.add_mesh(make_plane(8, 8), ground, "floor"), {0, -1.9, 0});
    detail::SampleRandom random(seed);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string name = "quad " + std::to_string(i);
        glm::dvec4 color(0, 0, 0, random.integer(51, 204));
        for (int c = 0; c < 3; ++c) color[c] = random.integer(0, 255);
        // In braces, arguments are evaluated in order.
        const glm::dvec3 center{random.between(-1.9, 1.9), random.between(-1.3, 1.5), random.between(-1.9, 1.9)};
        const glm::dvec3 normal = random.direction();
        const glm::dvec3 other = std::abs(normal.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const double width = random.between(0.5, 1.8), height = random.between(0.5, 1.8);
        const std::uint32_t material = builder.add_material(detail::unlit_material(color / 255.0, name));
        builder.place(builder.add_mesh(detail::make_pane(width, height), material, name),
                      detail::pane_frame(center, normal, other));
    }
    builder.scene.cameras.push_back(detail::sample_camera({2.2, 2.9, 8.9}, {0, -0.2, 0}, 0.62));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_cyclic_triangles() {
    detail::SceneBuilder builder;
    const glm::dvec3 colors[] = {{0.95, 0.12, 0.08}, {0.15, 0.80, 0.12}, {0.10, 0.25, 0.95}};
    const char* const names[] = {"red", "green", "blue"};
    // One arrow, near at its broad end and far at its tip, and the same a third and two thirds of a turn further.
    constexpr glm::dvec3 arrow[] = {{-1.15, -1.0, 0.5}, {1.95, -0.72, -0.5}, {-1.15, -0.15, 0.5}};
    const double c = -0.5, s = 0.5 * std::sqrt(3.0);
    for (int i = 0; i < 3; ++i) {
        Mesh mesh;
        for (glm::dvec3 p : arrow) {
            for (int turn = 0; turn < i; ++turn) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
            mesh.positions.push_back(glm::vec3(p));
        }
        const glm::dvec3 a(mesh.positions[0]), b(mesh.positions[1]), d(mesh.positions[2]);
        mesh.normals.assign(3, glm::vec3(glm::normalize(glm::cross(b - a, d - a))));
        mesh.indices = {0, 1, 2};
        update_bounds(mesh);
        const std::uint32_t material = builder.add_material(detail::unlit_material({colors[i], 0.6}, names[i]));
        builder.place(builder.add_mesh(std::move(mesh), material, names[i]));
    }
    builder.scene.cameras.push_back(detail::sample_camera({0, 0, 6.6}, {0, 0, 0}, 0.6));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_lit_glass(std::uint32_t seed) {
    detail::SceneBuilder builder;
    detail::SampleRandom random(seed);
    const std::uint32_t stone = builder.add_material(
        {.base_color = {0.36f, 0.35f, 0.33f, 1}, .metallic = 0, .roughness = 0.6f, .name = "floor"});
    const std::uint32_t copper = builder.add_material(
        {.base_color = {0.93f, 0.52f, 0.33f, 1}, .metallic = 1, .roughness = 0.42f, .name = "metal"});
    builder.place(builder.add_mesh(make_plane(16, 16), stone, "floor"));
    builder.place(builder.add_mesh(make_uv_sphere(0.8f, 48, 96), copper, "metal sphere"), {-0.75, 0.8, -0.7});

    const double hue = random.between(0, 1);
    const auto glass = [&](int i, float alpha, float roughness, const std::string& name) {
        const glm::dvec3 color = 0.08 + 0.84 * detail::hue_color(hue + 0.27 * i);
        return builder.add_material(detail::glass_material(glm::vec4(glm::vec3(color), alpha), roughness, name));
    };
    builder.place(builder.add_mesh(make_uv_sphere(0.72f, 48, 96), glass(0, 0.45f, 0.2f, "bubble"), "bubble"),
                  {0.75, 0.85, 0.35});
    struct Pane {
        glm::dvec3 position;
        double yaw, width, height;
        float alpha;
    };
    const Pane panes[] = {{{0.35, 0.95, 0.35}, 0.6, 2.4, 1.7, 0.35f},
                          {{0.95, 0.80, 0.55}, -0.7, 1.9, 1.4, 0.50f},
                          {{-0.55, 0.70, 0.75}, 0.1, 1.5, 1.2, 0.40f}};
    for (int i = 0; i < 3; ++i) {
        const Pane& pane = panes[i];
        const std::string name = "pane " + std::to_string(i);
        const double yaw = pane.yaw + random.between(-0.15, 0.15), lean = random.between(-0.1, 0.1);
        builder.place(
            builder.add_mesh(detail::make_pane(pane.width, pane.height), glass(i + 1, pane.alpha, 0.35f, name), name),
            detail::pane_frame(pane.position, {std::sin(yaw), lean, std::cos(yaw)},
                               {std::cos(yaw), 0, -std::sin(yaw)}));
    }
    builder.scene.lights = {{.kind = LightKind::directional,
                             .color = {1, 0.95f, 0.88f},
                             .intensity = 2,
                             .direction = glm::normalize(glm::dvec3(-0.5, -0.8, -0.6)),
                             .name = "sun"},
                            {.kind = LightKind::point,
                             .color = {0.45f, 0.65f, 1},
                             .intensity = 7,
                             .position = {1.9, 1.5, 1.8},
                             .name = "point"},
                            {.kind = LightKind::spot,
                             .color = {1, 0.8f, 0.5f},
                             .intensity = 45,
                             .inner_cone = 0.2,
                             .outer_cone = 0.38,
                             .position = {-2.4, 3.4, 2.2},
                             .direction = glm::normalize(glm::dvec3(1.9, -2.9, -2.4)),
                             .name = "spot"}};
    builder.scene.cameras.push_back(detail::sample_camera({0.9, 3.1, 6.2}, {0.05, 0.6, 0}, 0.6));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_teapot_grid(const TeapotGrid& grid) {
    assert(grid.columns >= 1 && grid.rows >= 1);
    constexpr double scale = 0.1, pitch_x = 0.52, pitch_z = 0.50;
    constexpr std::uint32_t kinds = 6;
    detail::SceneBuilder builder;
    const double width = grid.columns * pitch_x, depth = grid.rows * pitch_z;
    const std::uint32_t stone = builder.add_material(
        {.base_color = {0.22f, 0.23f, 0.25f, 1}, .metallic = 0, .roughness = 0.7f, .name = "floor"});
    builder.place(
        builder.add_mesh(make_plane(static_cast<float>(width + 0.6), static_cast<float>(depth + 0.6)), stone, "floor"));
    const Mesh teapot = make_teapot(grid.divisions);
    std::uint32_t first = 0;
    for (std::uint32_t kind = 0; kind < std::min(kinds, grid.columns * grid.rows); ++kind) {
        const std::string name = "glass " + std::to_string(kind);
        const glm::dvec3 color = 0.10 + 0.80 * detail::hue_color((kind + 0.3) / kinds);
        const std::uint32_t material =
            builder.add_material(detail::glass_material(glm::vec4(glm::vec3(color), 0.35f), 0.3f, name));
        const std::uint32_t mesh = builder.add_mesh(teapot, material, "teapot " + std::to_string(kind));
        if (kind == 0) first = mesh;
    }
    for (std::uint32_t row = 0; row < grid.rows; ++row)
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            glm::dmat4 world(1.0);
            world = glm::translate(
                world, {(column - 0.5 * (grid.columns - 1)) * pitch_x, 0.0, (row - 0.5 * (grid.rows - 1)) * pitch_z});
            world =
                glm::rotate(world, 0.5 + 0.35 * static_cast<double>((3 * row + 5 * column) % 7), glm::dvec3(0, 1, 0));
            builder.place(first + (row * grid.columns + column) % kinds, glm::scale(world, glm::dvec3(scale)));
        }
    builder.scene.lights.push_back({.kind = LightKind::directional,
                                    .color = {1, 0.97f, 0.92f},
                                    .intensity = 4,
                                    .direction = glm::normalize(glm::dvec3(-0.4, -0.8, -0.5)),
                                    .name = "sun"});
    // A square picture is to lose some at the sides: else a wide one is mostly empty.
    const glm::dvec3 extent(0.23 * width, 0.15, 0.5 * depth), up(0, 0.15, 0);
    builder.scene.cameras.push_back(detail::sample_camera_around(up - extent, up + extent, {0.08, 0.36, 1}, 0.55));
    return std::move(builder.scene);
}

PELLUCID_INLINE Scene make_sheets(const std::vector<Sheet>& sheets, std::uint32_t depth_bits) {
    assert(depth_bits >= 1 && depth_bits <= 24);
    detail::SceneBuilder builder;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Sheet& sheet = sheets[i];
        assert(sheet.slot >= 1 && sheet.slot < 1u << depth_bits);
        const auto steps = static_cast<double>((1u << depth_bits) - sheet.slot);
        const auto z = static_cast<float>(-std::ldexp(steps, -static_cast<int>(depth_bits)));
        Mesh mesh;
        mesh.positions = {{-4, -4, z}, {12, -4, z}, {-4, 12, z}};  // holds the square ±4
        mesh.normals.assign(3, {0, 0, 1});
        mesh.indices = {0, 1, 2};
        update_bounds(mesh);
        const std::string name = "sheet " + std::to_string(i);
        Material material = detail::unlit_material(glm::dvec4(sheet.color), name);
        material.alpha_mode = sheet.opaque ? AlphaMode::opaque : AlphaMode::blend;
        builder.place(builder.add_mesh(std::move(mesh), builder.add_material(std::move(material)), name));
    }
    builder.scene.cameras.push_back({.projection = Projection::orthographic,
                                     .half_width = 1,
                                     .half_height = 1,
                                     .near = 0,
                                     .far = 1,
                                     .name = "camera"});
    return std::move(builder.scene);
}

}  // namespace pellucid::inline v0_1
