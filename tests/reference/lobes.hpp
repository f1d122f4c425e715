// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The GGX distribution as papers write it, for the reference tests.
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

}  // namespace pellucid::test
