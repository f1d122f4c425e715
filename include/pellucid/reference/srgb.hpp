// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The transfer functions of sRGB (IEC 61966-2-1), piecewise as in the standard, never a plain power.
#include <cmath>
#include <concepts>
#include <cstdint>

namespace pellucid::inline v0_1::reference {

/// Linear light in [0,1] → sRGB signal in [0,1]: `12.92 x` up to 0.0031308, then `1.055 x^(1/2.4) − 0.055`.
/// The standard's constants leave a step of 3e-8 at the joint.  Precondition: x >= 0.
template <std::floating_point T>
[[nodiscard]] T srgb_from_linear(T linear) noexcept {
    return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

/// sRGB signal in [0,1] → linear light in [0,1]: `s/12.92` up to 0.04045, then `((s + 0.055)/1.055)^2.4`.
/// Precondition: s >= 0.
template <std::floating_point T>
[[nodiscard]] T linear_from_srgb(T signal) noexcept {
    return signal <= T(0.04045) ? signal / T(12.92) : std::pow((signal + T(0.055)) / T(1.055), T(2.4));
}

/// Value in [0,1] → 8-bit code, nearest (ties upward).  Below 0 and NaN: 0; above 1: 255.
template <std::floating_point T>
[[nodiscard]] std::uint8_t unorm8(T value) noexcept {
    if (!(value > T(0))) return 0;
    return value >= T(1) ? std::uint8_t{255} : static_cast<std::uint8_t>(value * T(255) + T(0.5));
}

/// Linear light → 8-bit sRGB code.  Below 0 and NaN: 0; above 1: 255.
template <std::floating_point T>
[[nodiscard]] std::uint8_t srgb8_from_linear(T linear) noexcept {
    return linear > T(0) ? unorm8(srgb_from_linear(linear < T(1) ? linear : T(1))) : std::uint8_t{0};
}

/// 8-bit sRGB code → linear light.  `srgb8_from_linear(linear_from_srgb8(c)) == c` for all 256 codes.
template <std::floating_point T = double>
[[nodiscard]] T linear_from_srgb8(std::uint8_t code) noexcept {
    return linear_from_srgb(static_cast<T>(code) / T(255));
}

}  // namespace pellucid::inline v0_1::reference
