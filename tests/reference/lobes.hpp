// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The GGX distribution as papers write it, and integrals of lobes over the hemisphere, for the reference tests.
#include "sampling.hpp"

namespace pellucid::test {

/// D as papers write it, from the angle between normal and half vector; in double, for α that double can hold.
[[nodiscard]] inline double textbook_distribution(double theta, double alpha) {
    const double t = std::tan(theta), c = std::cos(theta);
    const double a2 = alpha * alpha;
    return a2 / (std::numbers::pi * c * c * c * c * (a2 + t * t) * (a2 + t * t));
}

[[nodiscard]] inline double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return degrees_between(a, b) * std::numbers::pi / 180.0;
}

/// ∫ specular(V, L) dω over the hemisphere around z, V at cosine `mu`, by the midpoint rule over the half vector's
/// distribution: u -> tan²θ = α² u/(1−u), whose density D (N·H) comes from `textbook_distribution`.
template <class Specular>
[[nodiscard]] double specular_albedo(double mu, double roughness, int steps, Specular&& specular) {
    const double alpha = roughness * roughness;
    const glm::dvec3 v(std::sqrt(1 - mu * mu), 0, mu);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        // u = 1 − s² and s = t²(3 − 2t) grade the points toward the tail and the axis of the lobe.
        const double t = (i + 0.5) / steps, s = t * t * (3 - 2 * t), u = 1 - s * s;
        const double weight = 2 * s * 6 * t * (1 - t) / steps;
        const double theta = std::atan(alpha * std::sqrt(u) / s);
        for (int j = 0; j < steps; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / steps;  // the other half is its mirror image
            const glm::dvec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const double v_dot_h = glm::dot(v, h);
            if (v_dot_h <= 0) continue;
            const glm::dvec3 l = 2.0 * v_dot_h * h - v;
            const double density = textbook_distribution(theta, alpha) * h.z / (4 * v_dot_h);
            sum += weight / steps * specular(v, l) / density;
        }
    }
    return sum;
}

}  // namespace pellucid::test
