// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Scenes and questions that shadow maps must get right.
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <pellucid/reference/shadow_map.hpp>
#include <string>
#include <vector>
#include "support/light_cases.hpp"
#include "support/scene.hpp"

namespace pellucid::test {

/// Exact arithmetic, maps of `map_size` texels; a picture of 64×64.
[[nodiscard]] inline RenderSettings shadow_settings(std::uint32_t map_size, std::uint32_t picture = 64) {
    RenderSettings settings = settings_for(picture);
    settings.keep_gbuffer = false;
    settings.exact = true;
    settings.shadows = Shadows::map;
    settings.shadow_size = map_size;
    return settings;
}

[[nodiscard]] inline Light sun(glm::dvec3 direction, float intensity = 2) {
    return {.kind = LightKind::directional, .intensity = intensity, .direction = glm::normalize(direction)};
}
[[nodiscard]] inline Light bulb(glm::dvec3 position, float intensity = 20) {
    return {.kind = LightKind::point, .intensity = intensity, .position = position};
}
[[nodiscard]] inline Light torch(glm::dvec3 position, glm::dvec3 target, double outer = 0.9, float intensity = 20) {
    return {.kind = LightKind::spot,
            .intensity = intensity,
            .inner_cone = 0.9 * outer,
            .outer_cone = outer,
            .position = position,
            .direction = glm::normalize(target - position)};
}

/// A horizontal floor of half side `half` at height 0.
inline void add_floor(Scene& scene, float half) {
    add(scene, make_plane(2 * half, 2 * half), matte({0.8f, 0.8f, 0.8f}));
}
/// A square of half side `half` parallel to the floor, seen from both sides.
inline void add_sheet(Scene& scene, glm::dvec3 at_point, float half, Material material = matte({0.5f, 0.5f, 0.5f})) {
    material.double_sided = true;
    add(scene, quad(half, half), material,
        at(at_point.x, at_point.y, at_point.z) *
            glm::rotate(glm::dmat4(1), -0.5 * glm::pi<double>(), glm::dvec3(1, 0, 0)));
}

/// Looks straight down on the floor: x to the right, z down, `half` metres to each side of `center`.
[[nodiscard]] inline Camera plan_camera(glm::dvec3 center, double half, double height = 10) {
    return {.projection = Projection::orthographic,
            .half_width = half,
            .half_height = half,
            .near = 0.01,
            .far = 2 * height,
            .world_from_view = look_at(center + glm::dvec3(0, height, 0), center, {0, 0, -1})};
}
/// The point of the floor in the middle of a pixel of `plan_camera`.
[[nodiscard]] inline glm::dvec3 plan_point(glm::dvec3 center, double half, std::uint32_t size, std::uint32_t x,
                                           std::uint32_t y) {
    return center + glm::dvec3((2 * (x + 0.5) / size - 1) * half, 0, (2 * (y + 0.5) / size - 1) * half);
}

/// Pictures with shadows and without.
template <rhi::Backend B>
struct ShadowPair {
    Shot<B> with, without;
    /// [0,1] of each pixel: what of the light there was is left (green).
    [[nodiscard]] std::vector<double> share() const {
        std::vector<double> out;
        for (std::size_t i = 1; i < with.hdr.data.size(); i += 4)
            out.push_back(without.hdr.data[i] > 0 ? static_cast<double>(with.hdr.data[i]) / without.hdr.data[i] : 1.0);
        return out;
    }
    [[nodiscard]] std::size_t changed() const { return different_pixels(with.hdr, without.hdr); }
};
template <rhi::Backend B>
[[nodiscard]] ShadowPair<B> shadow_pair(typename B::Device& device, const Scene& scene, const Camera& camera,
                                        RenderSettings settings) {
    ShadowPair<B> pair;
    pair.with = shoot<B>(device, scene, camera, settings);
    settings.shadows = Shadows::none;
    pair.without = shoot<B>(device, scene, camera, settings);
    return pair;
}

}  // namespace pellucid::test
