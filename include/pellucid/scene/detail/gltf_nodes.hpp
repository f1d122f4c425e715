// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// From tinygltf's nodes, cameras and lights to instances, cameras and lights in the world.
#include <pellucid/scene/detail/gltf_container.hpp>
#include <pellucid/scene/detail/tiny_gltf.hpp>
#include <pellucid/scene/scene.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pellucid::inline v0_1::detail {

class GltfNodes {
public:
    /// `primitives[m]` are the meshes of the scene that the file's mesh m became.
    GltfNodes(const tinygltf::Model& model, Scene& scene, const std::vector<std::vector<std::uint32_t>>& primitives,
              std::uint32_t max_depth, GltfBudget& budget)
        : model_(model), scene_(scene), primitives_(primitives), max_depth_(max_depth), budget_(budget) {}

    /// Checks that the nodes are trees: no node has two parents, none is its own ancestor, the depth is limited, and
    /// that every node's matrix, every camera and every light is valid, also those that no scene shows.
    void check() {
        const std::size_t count = model_.nodes.size();
        parent_.assign(count, -1);
        for (std::size_t n = 0; n < count; ++n)
            for (std::size_t i = 0; i < model_.nodes[n].children.size(); ++i) {
                const int child = model_.nodes[n].children[i];
                const std::string place = pointer(n) + "/children/" + std::to_string(i);
                if (parent_[std::size_t(child)] >= 0)
                    gltf_fail(place + ": is node " + std::to_string(child) + ", which already is a child of node " +
                              std::to_string(parent_[std::size_t(child)]));
                parent_[std::size_t(child)] = static_cast<int>(n);
            }
        // With one parent each, a node is in a loop exactly where no root reaches it.
        depth_.assign(count, 0);
        std::vector<std::size_t> order;
        for (std::size_t n = 0; n < count; ++n)
            if (parent_[n] < 0) order.push_back(n);
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const int child : model_.nodes[order[i]].children) {
                depth_[std::size_t(child)] = depth_[order[i]] + 1;
                if (depth_[std::size_t(child)] > max_depth_)
                    gltf_fail(pointer(std::size_t(child)) + ": is " + std::to_string(depth_[std::size_t(child)]) +
                              " nodes below its root, the limit is " + std::to_string(max_depth_));
                order.push_back(std::size_t(child));
            }
        if (order.size() != count)
            for (std::size_t n = 0; n < count; ++n)
                if (parent_[n] >= 0 && depth_[n] == 0)
                    gltf_fail(pointer(n) + ": is its own ancestor, or below such a node");
        for (std::size_t n = 0; n < count; ++n) static_cast<void>(local(n));
        for (std::size_t i = 0; i < model_.cameras.size(); ++i) static_cast<void>(camera(i));
        for (std::size_t i = 0; i < model_.lights.size(); ++i) static_cast<void>(light(i));
        std::vector<std::size_t> seen_in(count, model_.scenes.size());
        for (std::size_t s = 0; s < model_.scenes.size(); ++s) check_scene(s, seen_in);
    }

    /// Places what the default scene shows: the file's "scene", else its first one, else every root node.
    void place() {
        std::vector<int> roots;
        if (!model_.scenes.empty()) {
            roots = model_.scenes[std::size_t(std::max(model_.defaultScene, 0))].nodes;
        } else {
            for (std::size_t n = 0; n < parent_.size(); ++n)
                if (parent_[n] < 0) roots.push_back(static_cast<int>(n));
        }
        struct Visit {
            std::size_t node;
            glm::dmat4 world_from_parent;
        };
        std::vector<Visit> stack;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            stack.push_back({std::size_t(*root), glm::dmat4(1.0)});
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const glm::dmat4 world = visit.world_from_parent * local(visit.node);
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r)
                    if (!(std::abs(world[c][r]) <= 1e30))
                        gltf_fail(pointer(visit.node) + ": its transform in the world is not finite or beyond 1e30");
            place_node(visit.node, world);
            const auto& children = model_.nodes[visit.node].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                stack.push_back({std::size_t(*child), world});
        }
    }

private:
    static std::string pointer(std::size_t node) { return "/nodes/" + std::to_string(node); }

    /// `seen_in[n]`: the last scene that listed node n.
    void check_scene(std::size_t s, std::vector<std::size_t>& seen_in) const {
        for (std::size_t i = 0; i < model_.scenes[s].nodes.size(); ++i) {
            const auto node = std::size_t(model_.scenes[s].nodes[i]);
            const std::string place = "/scenes/" + std::to_string(s) + "/nodes/" + std::to_string(i);
            if (parent_[node] >= 0)
                gltf_fail(place + ": node " + std::to_string(node) + " is no root, it is a child of node " +
                          std::to_string(parent_[node]));
            if (seen_in[node] == s) gltf_fail(place + ": node " + std::to_string(node) + " is listed twice");
            seen_in[node] = s;
        }
    }

    /// parent_from_node.
    [[nodiscard]] glm::dmat4 local(std::size_t n) const {
        const tinygltf::Node& node = model_.nodes[n];
        if (!node.matrix.empty()) {
            glm::dmat4 matrix;
            for (std::size_t i = 0; i < 16; ++i) matrix[int(i / 4)][int(i % 4)] = node.matrix[i];
            if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
                gltf_fail(pointer(n) + "/matrix: its last row is not 0, 0, 0, 1");
            return matrix;
        }
        glm::dmat4 matrix(1.0);
        if (!node.rotation.empty()) {
            const auto& r = node.rotation;
            const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
            // Files hold rounded values: up to 1 % is taken for rounding and undone.
            if (!(std::abs(length - 1.0) <= 0.01))
                gltf_fail(pointer(n) + "/rotation: its length is " + std::to_string(length) + ", must be 1");
            matrix = glm::mat4_cast(glm::dquat(r[3] / length, r[0] / length, r[1] / length, r[2] / length));
        }
        if (!node.scale.empty())
            for (int c = 0; c < 3; ++c) matrix[c] *= node.scale[std::size_t(c)];
        if (!node.translation.empty())
            matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
        return matrix;
    }

    void place_node(std::size_t n, const glm::dmat4& world) {
        const tinygltf::Node& node = model_.nodes[n];
        if (node.mesh >= 0) {
            const auto& meshes = primitives_[std::size_t(node.mesh)];
            budget_.take(meshes.size() * sizeof(Instance), pointer(n), "meshes and instances");
            for (const std::uint32_t mesh : meshes) scene_.instances.push_back({mesh, world});
        }
        if (node.camera >= 0) {
            Camera placed = camera(std::size_t(node.camera));
            if (placed.name.empty()) placed.name = node.name;
            placed.world_from_view = rigid(world);
            scene_.cameras.push_back(std::move(placed));
        }
        const auto extension = node.extensions.find("KHR_lights_punctual");
        if (extension != node.extensions.end()) {
            Light placed = light(std::size_t(extension->second.Get("light").GetNumberAsInt()));
            if (placed.name.empty()) placed.name = node.name;
            const glm::dmat4 frame = rigid(world);
            placed.position = glm::dvec3(world[3]);
            placed.direction = -glm::dvec3(frame[2]);
            scene_.lights.push_back(std::move(placed));
        }
    }

    /// The position and orientation of `world`: scale and shear are taken out, so that views and lights stay rigid.
    static glm::dmat4 rigid(const glm::dmat4& world) {
        const glm::dmat3 frame(world);
        const glm::dmat3 product = glm::transpose(frame) * frame;
        double error = glm::determinant(frame) > 0 ? 0 : 1;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r) error = std::max(error, std::abs(product[c][r] - (c == r ? 1.0 : 0.0)));
        if (error <= 1e-9) return world;  // already rigid: not a bit changes
        const auto unit = [](glm::dvec3 v, glm::dvec3 otherwise) {
            const double length = glm::length(v);
            return length > 0 ? v / length : otherwise;
        };
        const glm::dvec3 z = unit(glm::dvec3(world[2]), {0, 0, 1});
        const glm::dvec3 up = unit(glm::dvec3(world[1]), {0, 1, 0});
        const glm::dvec3 side = std::abs(glm::dot(up, z)) < 0.999999 ? up
                                : std::abs(z.y) < 0.9                ? glm::dvec3(0, 1, 0)
                                                                     : glm::dvec3(1, 0, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(side, z));
        return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), world[3]};
    }

    [[nodiscard]] Camera camera(std::size_t i) const {
        const tinygltf::Camera& source = model_.cameras[i];
        const std::string place = "/cameras/" + std::to_string(i);
        Camera camera;
        camera.name = source.name;
        if (source.type == "perspective") {
            camera.vertical_fov = source.perspective.yfov;
            camera.near = source.perspective.znear;
            if (!(camera.vertical_fov < 3.14159))
                gltf_fail(place + "/perspective/yfov: is " + std::to_string(camera.vertical_fov) +
                          ", must be below pi");
            if (source.perspective.zfar > 0 && source.perspective.zfar <= camera.near)
                gltf_fail(place + "/perspective/zfar: is " + std::to_string(source.perspective.zfar) +
                          ", must exceed znear " + std::to_string(camera.near));
        } else {
            camera.projection = Projection::orthographic;
            // A negative magnification mirrors the picture; the format advises against it and viewers ignore the sign.
            camera.half_width = std::abs(source.orthographic.xmag);
            camera.half_height = std::abs(source.orthographic.ymag);
            camera.near = source.orthographic.znear;
            camera.far = source.orthographic.zfar;
            if (camera.half_width == 0 || camera.half_height == 0)
                gltf_fail(place + "/orthographic: xmag and ymag must not be 0");
            if (camera.far <= camera.near)
                gltf_fail(place + "/orthographic/zfar: is " + std::to_string(camera.far) + ", must exceed znear " +
                          std::to_string(camera.near));
        }
        return camera;
    }

    [[nodiscard]] Light light(std::size_t i) const {
        const tinygltf::Light& source = model_.lights[i];
        const std::string place = "/extensions/KHR_lights_punctual/lights/" + std::to_string(i);
        Light light;
        light.name = source.name;
        for (std::size_t c = 0; c < source.color.size(); ++c) light.color[int(c)] = static_cast<float>(source.color[c]);
        light.intensity = static_cast<float>(source.intensity);
        light.range = static_cast<float>(source.range);
        if (source.type == "directional") {
            light.kind = LightKind::directional;
            light.range = 0;  // has no meaning there
        } else if (source.type == "spot") {
            light.kind = LightKind::spot;
            light.inner_cone = source.spot.innerConeAngle;
            light.outer_cone = std::min(source.spot.outerConeAngle, 0.5 * std::numbers::pi);
            if (!(light.inner_cone < light.outer_cone))
                gltf_fail(place + "/spot: innerConeAngle " + std::to_string(light.inner_cone) +
                          " must be below outerConeAngle " + std::to_string(light.outer_cone));
        } else if (source.type != "point") {
            gltf_fail(place + "/type: is \"" + gltf_printable(source.type) + "\", none of directional, point, spot");
        }
        return light;
    }

    const tinygltf::Model& model_;
    Scene& scene_;
    const std::vector<std::vector<std::uint32_t>>& primitives_;
    std::uint32_t max_depth_;
    GltfBudget& budget_;
    std::vector<int> parent_;
    std::vector<std::uint32_t> depth_;
};

}  // namespace pellucid::inline v0_1::detail
