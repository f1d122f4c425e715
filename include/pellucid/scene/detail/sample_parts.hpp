// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the library's own scenes are made of: numbers, colours, materials, panes and cameras.
#include <pellucid/scene/detail/scene_builder.hpp>
#include <pellucid/scene/primitives.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace pellucid::inline v0_1::detail {

inline constexpr double sample_pi = 3.14159265358979323846;

/// Numbers that are the same everywhere: the standard fixes what mt19937 gives, not what its distributions do.
class SampleRandom {
public:
    explicit SampleRandom(std::uint32_t seed) : bits_(seed) {}
    /// In [low, high), a multiple of (high - low) 2^-24.
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(bits_() >> 8) * 0x1p-24);
    }
    /// In first … last.
    std::uint32_t integer(std::uint32_t first, std::uint32_t last) {
        return first + static_cast<std::uint32_t>(std::uint64_t{bits_()} * (last - first + 1) >> 32);
    }
    /// Uniform on the sphere, by rejection: products and a square root only.
    glm::dvec3 direction() {
        for (;;) {
            const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1), square = x * x + y * y + z * z;
            if (square > 1e-4 && square <= 1) return glm::dvec3(x, y, z) / std::sqrt(square);
        }
    }

private:
    std::mt19937 bits_;
};

/// Fully saturated colour of a hue in [0,1): red, yellow, green, cyan, blue, magenta and what is between.
inline glm::dvec3 hue_color(double hue) {
    const auto ramp = [&](double offset) {
        const double x = hue * 6 + offset, y = x - 6 * std::floor(x / 6);
        return std::clamp(std::abs(y - 3) - 1, 0.0, 1.0);
    };
    return {ramp(0), ramp(4), ramp(2)};
}

inline Material unlit_material(glm::dvec4 color, std::string name) {
    return {.base_color = glm::vec4(color),
            .metallic = 0,
            .alpha_mode = color.w < 1 ? AlphaMode::blend : AlphaMode::opaque,
            .double_sided = true,
            .unlit = true,
            .name = std::move(name)};
}
inline Material glass_material(glm::vec4 color, float roughness, std::string name) {
    return {.base_color = color,
            .metallic = 0,
            .roughness = roughness,
            .alpha_mode = AlphaMode::blend,
            .double_sided = true,
            .name = std::move(name)};
}

/// World from a pane that faces `z` (any length) at `position`, its x axis the part of `near_x` orthogonal to z.
inline glm::dmat4 pane_frame(glm::dvec3 position, glm::dvec3 z, glm::dvec3 near_x) {
    z = glm::normalize(z);
    const glm::dvec3 y = glm::normalize(glm::cross(z, near_x));
    return {glm::dvec4(glm::cross(y, z), 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
}

/// Rectangle in the plane z = 0 facing +z, centred on the origin.
inline Mesh make_pane(double width, double height) {
    Mesh mesh;
    for (const glm::vec2 corner : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
        mesh.positions.push_back(glm::vec3((corner.x - 0.5) * width, (0.5 - corner.y) * height, 0));
        mesh.normals.push_back({0, 0, 1});
        mesh.uv0.push_back(corner);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    update_bounds(mesh);
    return mesh;
}

inline Camera sample_camera(glm::dvec3 eye, glm::dvec3 target, double vertical_fov) {
    Camera camera{.vertical_fov = vertical_fov, .near = 0.1, .name = "camera"};
    camera.world_from_view = look_at(eye, target);
    return camera;
}
/// Looks along -`direction` at the middle of a box, from just so far that a square picture has all of it.
inline Camera sample_camera_around(glm::dvec3 lower, glm::dvec3 upper, glm::dvec3 direction, double vertical_fov) {
    const glm::dvec3 middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
    const glm::dmat4 axes = look_at(glm::normalize(direction), glm::dvec3(0));
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double aside =
            std::max(std::abs(glm::dot(glm::dvec3(axes[0]), p)), std::abs(glm::dot(glm::dvec3(axes[1]), p)));
        distance = std::max(distance, glm::dot(glm::dvec3(axes[2]), p) + aside / std::tan(0.5 * vertical_fov));
    }
    return sample_camera(middle + 1.04 * distance * glm::dvec3(axes[2]), middle, vertical_fov);
}

}  // namespace pellucid::inline v0_1::detail
