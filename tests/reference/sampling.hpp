// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Directions for the reference tests: a seeded sequence that is the same with every standard library.
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>

namespace pellucid::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Uniform in [0,1).
    double uniform() { return static_cast<double>(engine_() >> 11u) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform on the unit sphere.
    glm::dvec3 direction() {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// Uniform on the hemisphere around `axis` (unit).
    glm::dvec3 direction_above(glm::dvec3 axis) {
        const glm::dvec3 d = direction();
        return glm::dot(d, axis) < 0 ? -d : d;
    }

private:
    std::mt19937_64 engine_;
};

/// A unit vector at `angle` [rad] from `axis` (unit), turned around it by `turn` [rad].
[[nodiscard]] inline glm::dvec3 tilted(glm::dvec3 axis, double angle, double turn) {
    const glm::dvec3 other = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    return glm::normalize(axis * std::cos(angle) + (u * std::cos(turn) + v * std::sin(turn)) * std::sin(angle));
}

/// Angle between two vectors [deg], exact also where it is tiny.
[[nodiscard]] inline double degrees_between(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

}  // namespace pellucid::test
