// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Indexed triangles as the CPU holds them: one `Mesh` a glTF primitive.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// A triangle list with one material.  Every non-empty attribute has `positions.size()` values; every index is below
/// it; `indices.size()` is a multiple of 3; positions are finite.  Normals are always there (flat ones are made where
/// a file has none); tangents are there where the material has a normal map.
struct Mesh {
    std::vector<glm::vec3> positions = {};  ///< [m] object space
    std::vector<glm::vec3> normals = {};    ///< unit
    std::vector<glm::vec4> tangents = {};   ///< xyz unit, w = ±1: bitangent = w cross(normal, tangent); or empty
    std::vector<glm::vec2> uv0 = {};        ///< or empty
    std::vector<glm::vec2> uv1 = {};        ///< or empty
    std::vector<glm::vec4> colors = {};     ///< linear straight RGBA in [0,1]; or empty
    std::vector<std::uint32_t> indices = {};
    std::uint32_t material = 0;                ///< index into Scene::materials
    glm::vec3 lower{0, 0, 0}, upper{0, 0, 0};  ///< [m] bounds in object space
    std::string name = {};
};

}  // namespace pellucid::inline v0_1
