// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// binary16 as IEEE 754 rounds by default.  `half_toward_zero` of the library is how GPUs store it.
#include <cmath>
#include <pellucid/core/half.hpp>

namespace pellucid::bench {

/// float → binary16 bits, to nearest, ties to even; from 65520 on infinity.  Infinities and NaN stay.
[[nodiscard]] inline std::uint16_t half_nearest(float value) noexcept {
    const std::uint16_t low = half_toward_zero(value);
    if ((low & 0x7C00u) == 0x7C00u) return low;
    const auto high = static_cast<std::uint16_t>(low + 1u);  // the next one away from zero, by the order of the bits
    const auto magnitude = [](std::uint16_t half) {
        const std::uint32_t bits = half & 0x7FFFu;
        return bits == 0x7C00u ? 65536.0 : double{half_to_float(static_cast<std::uint16_t>(bits))};
    };
    const double below = std::abs(double{value}) - magnitude(low), above = magnitude(high) - std::abs(double{value});
    return below < above || (below == above && low % 2 == 0) ? low : high;
}

}  // namespace pellucid::bench
