// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the reference renderer draws: a scene's instances in draw order with their matrices and materials, checked.
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <numbers>
#include <pellucid/reference/lighting.hpp>
#include <pellucid/reference/detail/triangle_tree.hpp>
#include <pellucid/reference/raster.hpp>
#include <pellucid/reference/renderer.hpp>
#include <pellucid/reference/surface.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1::reference::detail {

/// A corner in front of the eye, moved in x and y to the nearest point of a grid of 1/`steps` pixel.
[[nodiscard]] inline glm::dvec4 on_grid(const glm::dvec4& p, Extent2D size, std::uint32_t steps) noexcept {
    const auto moved = [&](double x, std::uint32_t pixels) {  // row 0 at the top or at the bottom: the same grid
        const double half = 0.5 * pixels * steps;
        return (std::nearbyint((x / p.w + 1) * half) / half - 1) * p.w;
    };
    return {moved(p.x, size.width), moved(p.y, size.height), p.z, p.w};
}

/// One instance in draw order.
struct Draw {
    const Mesh* mesh = nullptr;
    const TexturedMaterial* material = nullptr;
    std::uint32_t instance = 0;         ///< index into Scene::instances
    std::uint32_t first_primitive = 0;  ///< in draw order
    std::uint32_t end_primitive = 0;
    Placement placed;
    glm::dmat4 view_from_object{1.0};

    [[nodiscard]] bool blended() const noexcept { return material->factors.alpha_mode == AlphaMode::blend; }
    /// The triangle's vertices, in the mesh.
    [[nodiscard]] const std::uint32_t* corners(std::uint32_t primitive) const noexcept {
        return mesh->indices.data() + std::size_t{3} * (primitive - first_primitive);
    }
    /// Seen from its front side.  Precondition: `triangle` is not seen edge-on.
    [[nodiscard]] bool front(const RasterTriangle& triangle) const noexcept {
        return (triangle.facing() > 0) != placed.mirrored;
    }
};

/// Everything that drawing takes, the same for all pixels.
struct Prepared {
    Camera camera;
    ClipFromView clip;
    const RenderOptions* options = nullptr;
    std::vector<std::unique_ptr<SampledTexture>> color_textures, data_textures;  ///< of Scene::textures; null: not used
    std::vector<TexturedMaterial> materials;                                     ///< of Scene::materials
    std::vector<Draw> draws;
    std::uint32_t primitives = 0;
    std::optional<EnvironmentLight> environment;
    TriangleTree casters;  ///< opaque and masked triangles in world space; empty where no shadows were asked for

    [[nodiscard]] RasterTriangle triangle(const Draw& draw, std::uint32_t primitive) const noexcept {
        const std::uint32_t* at = draw.corners(primitive);
        const auto corner = [&](std::uint32_t vertex) {
            const glm::dvec4 object(draw.mesh->positions[vertex], 1.0);
            const glm::dvec4 p = clip_from_point(clip, glm::dvec3(draw.view_from_object * object));
            return options->corner_grid != 0 && p.w > 0 ? on_grid(p, options->size, options->corner_grid) : p;
        };
        return {corner(at[0]), corner(at[1]), corner(at[2])};
    }
    [[nodiscard]] glm::dvec3 backward() const noexcept { return glm::dvec3(camera.world_from_view[2]); }
};

[[nodiscard]] inline Result<void> check_camera(const Camera& camera) {
    const auto fail = [&](const std::string& what) -> Result<void> {
        return Error{Errc::invalid_argument, "the camera \"" + camera.name + "\": " + what};
    };
    const auto number = [&](const char* what, double value, const char* limit) {
        return fail(std::string(what) + " is " + std::to_string(value) + ", but must be " + limit);
    };
    const glm::dmat4& m = camera.world_from_view;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return number("an element of world_from_view", m[c][r], "finite");
    const glm::dmat3 axes(m), product = glm::transpose(axes) * axes;
    bool rigid = glm::determinant(axes) > 0 && m[3][3] == 1;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) rigid = rigid && std::abs(product[c][r] - (c == r)) <= 1e-5 && m[c][3] == 0;
    if (!rigid) return fail("world_from_view is not rigid; take scale, shear, mirroring and projection out of it");
    if (camera.projection == Projection::perspective) {
        if (!(camera.vertical_fov > 0 && camera.vertical_fov < std::numbers::pi))
            return number("vertical_fov", camera.vertical_fov, "in (0, pi) rad");
        if (!(camera.near > 0) || !std::isfinite(camera.near))
            return number("near", camera.near, "finite and above 0 m");
        return {};
    }
    if (!(camera.half_height > 0) || !std::isfinite(camera.half_height))
        return number("half_height", camera.half_height, "finite and above 0 m");
    if (!(camera.near >= 0) || !std::isfinite(camera.near))
        return number("near", camera.near, "finite and at least 0 m");
    if (!(camera.far > camera.near) || !std::isfinite(camera.far))
        return number("far", camera.far, "finite and above near");
    return {};
}

[[nodiscard]] inline Result<void> check_options(const RenderOptions& options) {
    for (const std::uint32_t side : {options.size.width, options.size.height})
        if (side < 1 || side > max_picture_side)
            return Error{Errc::invalid_argument, "the picture's size is " + std::to_string(options.size.width) + "x" +
                                                     std::to_string(options.size.height) + "; each side must be 1 to " +
                                                     std::to_string(max_picture_side)};
    if (options.corner_grid > 65536)
        return Error{Errc::invalid_argument, "the grid of corners has " + std::to_string(options.corner_grid) +
                                                 " steps a pixel; it must have 65536 at most"};
    for (int i = 0; i < 3; ++i)
        for (const auto& [what, value] :
             {std::pair{"background", options.background[i]}, std::pair{"ambient", options.ambient[i]}})
            if (!std::isfinite(value))
                return Error{Errc::invalid_argument, std::string("a component of the ") + what + " is " +
                                                         std::to_string(value) + ", but must be finite"};
    return check_lights(options.lights);
}

/// The instances that are drawn, opaque and masked ones first.  Materials are bound by `bind_materials`.
[[nodiscard]] inline Result<void> list_draws(const Scene& scene, Prepared& out) {
    const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(out.camera.world_from_view));
    const glm::dvec3 eye(out.camera.world_from_view[3]);
    std::uint64_t primitives = 0;
    out.materials.resize(scene.materials.size());
    for (const bool blended : {false, true}) {
        if (blended && !out.options->translucent) continue;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
            const Instance& instance = scene.instances[i];
            const Mesh& mesh = scene.meshes[instance.mesh];
            if ((scene.materials[mesh.material].alpha_mode == AlphaMode::blend) != blended || mesh.indices.empty())
                continue;
            const glm::dmat4& m = instance.world_from_object;
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r)
                    if (!std::isfinite(m[c][r]))
                        return Error{Errc::invalid_argument, "instance " + std::to_string(i) +
                                                                 ": an element of world_from_object is " +
                                                                 std::to_string(m[c][r]) + ", but must be finite"};
            Draw draw{.mesh = &mesh, .material = &out.materials[mesh.material], .instance = i, .placed = placement(m)};
            // The eye is taken off before anything is turned, so that no digits go where the scene is far away.
            const glm::dmat3 axes = view_from_world * glm::dmat3(m);
            draw.view_from_object = glm::dmat4(axes);
            draw.view_from_object[3] = glm::dvec4(view_from_world * (glm::dvec3(m[3]) - eye), 1);
            draw.first_primitive = static_cast<std::uint32_t>(primitives);
            primitives += mesh.indices.size() / 3;
            if (primitives >= ~0u)
                return Error{Errc::invalid_argument,
                             "the scene's instances have " + std::to_string(primitives) +
                                 " triangles or more; at most 4294967294 can be drawn: leave some out"};
            draw.end_primitive = static_cast<std::uint32_t>(primitives);
            out.draws.push_back(draw);
        }
    }
    out.primitives = static_cast<std::uint32_t>(primitives);
    return {};
}

}  // namespace pellucid::inline v0_1::reference::detail
