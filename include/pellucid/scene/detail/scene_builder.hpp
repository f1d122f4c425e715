// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Puts scenes together: used by the scenes that this library makes itself.
#include <pellucid/scene/scene.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <utility>

namespace pellucid::inline v0_1::detail {

class SceneBuilder {
public:
    Scene scene;

    std::uint32_t add_material(Material material) {
        scene.materials.push_back(std::move(material));
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
    std::uint32_t add_mesh(Mesh mesh, std::uint32_t material, std::string name) {
        mesh.material = material;
        mesh.name = std::move(name);
        scene.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(scene.meshes.size() - 1);
    }
    /// Turned by `yaw` [rad] about y, then moved.
    void place(std::uint32_t mesh, glm::dvec3 position = {0, 0, 0}, double yaw = 0) {
        const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), position);
        place(mesh, yaw == 0 ? moved : glm::rotate(moved, yaw, glm::dvec3(0, 1, 0)));
    }
    void place(std::uint32_t mesh, const glm::dmat4& world_from_object) {
        scene.instances.push_back({mesh, world_from_object});
    }
};

}  // namespace pellucid::inline v0_1::detail
