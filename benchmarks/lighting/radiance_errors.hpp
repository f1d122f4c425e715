// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Radiance of sampled pixels against the double-precision formulae.
#include <glm/vec3.hpp>
#include <pellucid/core/half.hpp>
#include "support/error_sample.hpp"

namespace pellucid::bench {

/// Errors are scaled by max(1, reference).  The target's own rounding (binary16, toward zero: up to 9.8e-4 of the
/// value) is in them; it is not in `off_code`.
class RadianceErrors {
public:
    void add(const float* value, const glm::dvec3& reference) {
        for (int c = 0; c < 3; ++c) {
            scaled.add_scaled(value[c], reference[c]);
            off_ += value[c] != half_to_float(half_toward_zero(static_cast<float>(reference[c])));
        }
    }
    /// The share of values that are not the code that the reference rounds to.
    [[nodiscard]] double off_code() const {
        return static_cast<double>(off_) / static_cast<double>(std::max<std::size_t>(1, scaled.count()));
    }

    ErrorSample scaled;
    std::uint32_t below_horizon = 0;  ///< pairs of a light and a pixel that do not see each other

private:
    std::size_t off_ = 0;
};

}  // namespace pellucid::bench
