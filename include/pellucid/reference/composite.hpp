// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Front-to-back compositing in double (Porter and Duff's "over", nearest layer first), in premultiplied colours:
/// C += T c, T ← T (1 − a), starting from C = 0 and T = 1, and at the end C + T background.
#include <glm/vec3.hpp>

namespace pellucid::inline v0_1::reference {

/// The layers of one pixel so far.
struct Composite {
    glm::dvec3 color{0, 0, 0};  ///< [cd/m²] what reaches the eye from the layers so far
    double transmittance = 1;   ///< [0,1] of what lies behind them

    /// Puts a layer behind the others.  `premultiplied` [cd/m²] is all that it sends out itself; it lets 1 − alpha
    /// through.  Alpha in [0,1].
    void put_behind(const glm::dvec3& premultiplied, double alpha) noexcept {
        color += transmittance * premultiplied;
        transmittance *= 1 - alpha;
    }
    [[nodiscard]] glm::dvec3 over(const glm::dvec3& background) const noexcept {
        return color + transmittance * background;
    }
};

}  // namespace pellucid::inline v0_1::reference
