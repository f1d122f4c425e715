// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A scene on the CPU: what a glTF file holds after it has been checked.  Every index in it is valid.
#include <pellucid/scene/camera.hpp>
#include <pellucid/scene/light.hpp>
#include <pellucid/scene/material.hpp>
#include <pellucid/scene/mesh.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// One mesh placed in the world.  The order of instances is the draw order: at equal depth the later one is in front.
struct Instance {
    std::uint32_t mesh = 0;  ///< index into Scene::meshes
    glm::dmat4 world_from_object{1.0};
};

/// Everything that is drawn, in arrays that refer to each other by index.
struct Scene {
    std::vector<Mesh> meshes = {};
    std::vector<Instance> instances = {};
    std::vector<Material> materials = {};  ///< at least one where there are meshes
    std::vector<SceneTexture> textures = {};
    std::vector<SceneImage> images = {};
    std::vector<Light> lights = {};
    std::vector<Camera> cameras = {};
    std::vector<std::string> warnings = {};  ///< what the loader passed over, a sentence each
};

}  // namespace pellucid::inline v0_1
