// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Punctual lights with the units and meanings of KHR_lights_punctual.
#include <pellucid/core/result.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <string>

namespace pellucid::inline v0_1 {

/// The three kinds of KHR_lights_punctual.
enum class LightKind : std::uint8_t { directional, point, spot };

/// A punctual light; `check_light` checks the ranges.
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
    std::string name = {};
};

/// Whether a point or spot light ends at its range.
[[nodiscard]] inline bool reaches_an_end(const Light& light) {
    return light.range > 0 && light.range < std::numeric_limits<float>::infinity();
}

/// Checks the ranges documented above, each member whatever the kind, but for cones (spots only) and the direction (not
/// of points), and that intensity times colour is a float.  `index` names the light in the sentence.
/// Errors: Errc::invalid_argument.
[[nodiscard]] inline Result<void> check_light(const Light& light, std::size_t index) {
    const auto text = [](double value) {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.9g", value);
        return std::string(digits);
    };
    const auto fail = [&](const char* what, double value, const std::string& limit) -> Result<void> {
        return Error{Errc::invalid_argument, "light " + std::to_string(index) + " (\"" + light.name + "\"): " + what +
                                                 " is " + text(value) + ", but must be " + limit};
    };
    for (int i = 0; i < 3; ++i) {
        if (!(light.color[i] >= 0) || !std::isfinite(light.color[i]))
            return fail("a component of its color", light.color[i], "finite and at least 0");
        if (!std::isfinite(light.position[i])) return fail("a component of its position", light.position[i], "finite");
    }
    if (!(light.intensity >= 0) || !std::isfinite(light.intensity))
        return fail("its intensity", light.intensity, "finite and at least 0");
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(light.intensity * light.color[i]))
            return fail("its intensity times a component of its color",
                        static_cast<double>(light.intensity) * static_cast<double>(light.color[i]),
                        "below 3.4e38, the largest float");
    if (!(light.range >= 0)) return fail("its range", light.range, "at least 0 m (0: unlimited)");
    const double length = glm::length(light.direction);
    if (light.kind != LightKind::point && !(std::abs(length - 1.0) <= 1e-6))
        return fail("the length of its direction", length, "1");
    if (light.kind != LightKind::spot) return {};
    if (!(light.outer_cone > 0 && light.outer_cone <= 0.5 * std::numbers::pi))
        return fail("its outer cone", light.outer_cone, "in (0, pi/2] rad");
    if (!(light.inner_cone >= 0 && light.inner_cone < light.outer_cone))
        return fail("its inner cone", light.inner_cone,
                    "at least 0 and below its outer cone, " + text(light.outer_cone) + " rad");
    return {};
}

/// `check_light` of each; the first error.
[[nodiscard]] inline Result<void> check_lights(std::span<const Light> lights) {
    for (std::size_t i = 0; i < lights.size(); ++i) PELLUCID_CHECK(check_light(lights[i], i));
    return {};
}

}  // namespace pellucid::inline v0_1
