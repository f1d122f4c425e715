// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// IEEE 754 binary16 conversions.  The GPUs measured here round toward zero when they write RGBA16F (attachment and
/// image store alike), so references that must match a stored pixel use `half_toward_zero`.
#include <bit>
#include <cstdint>

namespace pellucid::inline v0_1 {

/// binary16 bits → float, exact (also subnormals, infinities, NaN).
[[nodiscard]] constexpr float half_to_float(std::uint16_t half) noexcept {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000u) << 16u;
    const std::uint32_t exponent = (half >> 10u) & 0x1Fu;
    std::uint32_t mantissa = half & 0x3FFu;
    if (exponent == 31u) return std::bit_cast<float>(sign | 0x7F800000u | mantissa << 13u);
    if (exponent != 0u) return std::bit_cast<float>(sign | (exponent + 112u) << 23u | mantissa << 13u);
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign ? -magnitude : magnitude;
}

/// float → binary16 bits, rounding toward zero; finite values beyond 65504 become 65504, infinities and NaN stay.
[[nodiscard]] constexpr std::uint16_t half_toward_zero(float value) noexcept {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>(bits >> 16u & 0x8000u);
    const std::uint32_t magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u) return static_cast<std::uint16_t>(sign | 0x7E00u);
    if (magnitude == 0x7F800000u) return static_cast<std::uint16_t>(sign | 0x7C00u);
    if (magnitude >= 0x47800000u) return static_cast<std::uint16_t>(sign | 0x7BFFu);
    if (magnitude >= 0x38800000u) return static_cast<std::uint16_t>(sign | (magnitude - 0x38000000u) >> 13u);
    const auto tiny = static_cast<std::uint32_t>(std::bit_cast<float>(magnitude) * 0x1p24f);  // truncates
    return static_cast<std::uint16_t>(sign | tiny);
}

}  // namespace pellucid::inline v0_1
