// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Small scenes, and pictures of them with their G-buffer, for tests of passes and of the renderer.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <pellucid/reference/gbuffer.hpp>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/primitives.hpp>
#include <utility>
#include <vector>
#include "support/devices.hpp"

namespace pellucid::test {

/// A rectangle in the plane z = 0 that faces +z, with these half sizes [m]; uv (0,0) at its top left.
[[nodiscard]] inline Mesh quad(float half_x = 1, float half_y = 1) {
    Mesh mesh;
    mesh.positions = {{-half_x, half_y, 0}, {-half_x, -half_y, 0}, {half_x, -half_y, 0}, {half_x, half_y, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uv0 = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    update_bounds(mesh);
    return mesh;
}

/// Adds a mesh with a material of its own, placed once.  Returns the instance's index.
inline std::uint32_t add(Scene& scene, Mesh mesh, const Material& material, const glm::dmat4& world = glm::dmat4(1)) {
    mesh.material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(material);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size() - 1), world});
    return static_cast<std::uint32_t>(scene.instances.size() - 1);
}
[[nodiscard]] inline glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z));
}
[[nodiscard]] inline glm::dmat4 scaled(double x, double y, double z) {
    return glm::scale(glm::dmat4(1), glm::dvec3(x, y, z));
}

/// A dielectric of one colour.
[[nodiscard]] inline Material matte(glm::vec3 color, float roughness = 1) {
    return {.base_color = {color, 1}, .metallic = 0, .roughness = roughness};
}
/// A surface that shows its own colour, whatever the light; alpha below 1 blends.
[[nodiscard]] inline Material flat(glm::vec4 color, AlphaMode mode = AlphaMode::opaque) {
    return {.base_color = color, .alpha_mode = mode, .unlit = true};
}

/// An orthographic view of [-1,1]² from z = 10 along -z: `[n, n]` pixels of 2/n metres.
[[nodiscard]] inline Camera flat_camera() {
    return {.projection = Projection::orthographic,
            .half_width = 1,
            .half_height = 1,
            .near = 1,
            .far = 20,
            .world_from_view = at(0, 0, 10)};
}

/// A renderer and the last frame it drew.
template <rhi::Backend B>
struct Shot {
    std::unique_ptr<Renderer<B>> renderer;
    ImageF hdr;

    /// The compact G-buffer, in rows; needs settings.keep_gbuffer and an opaque surface.
    [[nodiscard]] std::vector<reference::CompactTexel> compact() const {
        const auto read = [&](std::size_t i) -> rhi::Texels { return must(renderer->read_gbuffer(i)); };
        const rhi::Texels normal = read(0), base = read(1), material = read(2), depth = read(Renderer<B>::depth_index);
        std::vector<reference::CompactTexel> out;
        for (std::uint32_t y = 0; y < depth.size.height; ++y)
            for (std::uint32_t x = 0; x < depth.size.width; ++x)
                out.push_back({normal.at<std::uint32_t>(x, y), base.at<std::uint32_t>(x, y),
                               material.at<std::uint32_t>(x, y), depth.at<float>(x, y)});
        return out;
    }
};

/// One frame.  Errors fail the test.
template <rhi::Backend B>
[[nodiscard]] Shot<B> shoot(typename B::Device& device, const Scene& scene, const Camera& camera,
                            const RenderSettings& settings) {
    Shot<B> out;
    out.renderer = must(Renderer<B>::create(device, scene, settings));
    (void)must(out.renderer->render(camera));
    out.hdr = must(out.renderer->read_hdr());
    return out;
}

/// Settings of most tests: a square picture, black where nothing is, the G-buffer kept, no light of its own, and the
/// method of transparency whose pipelines are built fastest.
[[nodiscard]] inline RenderSettings settings_for(std::uint32_t size) {
    return {.size = {size, size},
            .transparency = Transparency::sorted,
            .background = {0, 0, 0},
            .default_light = false,
            .keep_gbuffer = true};
}

/// Spheres and a plane of several materials, lit by lights of every kind: what pictures are compared on.
[[nodiscard]] inline Scene varied_scene() {
    Scene scene;
    add(scene, make_plane(8, 8), matte({0.8f, 0.7f, 0.5f}, 0.7f), at(0, -0.5, 0));
    add(scene, make_uv_sphere(0.5f, 24, 48), matte({0.9f, 0.1f, 0.1f}, 0.4f), at(-1.1, 0, 0));
    Material gold{.base_color = {1.0f, 0.78f, 0.34f, 1}, .metallic = 1, .roughness = 0.3f};
    add(scene, make_uv_sphere(0.5f, 24, 48), gold);
    gold.metallic = 0.5f, gold.roughness = 0.2f;
    add(scene, make_uv_sphere(0.5f, 24, 48), gold, at(1.1, 0, 0) * scaled(1, 1, 0.5));
    scene.lights.push_back(
        {.kind = LightKind::directional, .intensity = 1, .direction = glm::normalize(glm::dvec3(-0.4, -1, -0.3))});
    scene.lights.push_back({.color = {1, 0.5f, 0.2f}, .intensity = 2, .position = {0.5, 1.2, 1}});
    scene.lights.push_back({.color = {0.2f, 0.5f, 1}, .intensity = 4, .range = 3, .position = {-1.5, 1, 1.2}});
    scene.lights.push_back({.kind = LightKind::spot,
                            .intensity = 6,
                            .inner_cone = 0.2,
                            .outer_cone = 0.5,
                            .position = {1.5, 2, 1},
                            .direction = glm::normalize(glm::dvec3(-0.4, -2, -0.8))});
    return scene;
}
[[nodiscard]] inline Camera varied_camera() {
    return {.world_from_view = look_at({0.4, 1.1, 3.2}, {0, -0.1, 0})};
}

}  // namespace pellucid::test
