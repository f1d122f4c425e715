// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Punctual lights with the units and meanings of KHR_lights_punctual.
#include <glm/vec3.hpp>
#include <cstdint>
#include <limits>
#include <string>

namespace pellucid {

enum class LightKind : std::uint8_t { directional, point, spot };

struct Light {
    LightKind kind = LightKind::point;
    glm::vec3 color{1, 1, 1};                ///< linear, each >= 0
    float intensity = 1;                     ///< [lx] directional, [cd] point and spot; >= 0
    float range = 0;                         ///< [m] > 0; 0: unlimited
    double inner_cone = 0;                   ///< [rad] spot: half angle of full intensity, in [0, outer_cone)
    double outer_cone = 0.7853981633974483;  ///< [rad] spot: half angle of no intensity, in (0, pi/2]
    glm::dvec3 position{0, 0, 0};            ///< [m] world
    glm::dvec3 direction{0, 0, -1};          ///< world, unit: the way the light travels
    bool shadows = true;                     ///< it casts shadows where a renderer is asked for them
    std::string name;
};

/// Whether a point or spot light ends at its range.
[[nodiscard]] inline bool reaches_an_end(const Light& light) {
    return light.range > 0 && light.range < std::numeric_limits<float>::infinity();
}

}  // namespace pellucid
