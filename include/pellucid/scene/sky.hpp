// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The procedural sky, and what diffuse and glossy surfaces see of it as one table small enough for any GPU.  The sky
/// depends on height alone, so that is a function of two numbers: no cube map is needed.
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <glm/vec3.hpp>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

namespace pellucid::inline v0_1 {

/// Three colours, linear radiance.  The defaults are those of the document that the project grew from.
struct Sky {
    glm::vec3 horizon{0.6f, 0.6f, 0.5f};
    glm::vec3 zenith{0.3f, 0.5f, 0.9f};
    glm::vec3 nadir{0.1f, 0.08f, 0.06f};
};

/// mix(horizon, zenith or nadir, |y|^0.4), y in [-1,1] the upward component of a unit direction: continuous, with an
/// infinite slope at the horizon.  The absolute value comes first: a power of a negative number is NaN.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> sky_radiance(const Sky& sky, T y) noexcept {
    const T share = std::pow(std::min(std::abs(y), T(1)), T(0.4));
    return glm::vec<3, T>(sky.horizon) * (T(1) - share) + glm::vec<3, T>(y > T(0) ? sky.zenith : sky.nadir) * share;
}

/// The size of the table; texels are RGB, so that it takes 12 KiB as float32 and 6 KiB as binary16.
inline constexpr std::uint32_t sky_columns = 64;  ///< over y, the upward component of a unit direction
inline constexpr std::uint32_t sky_rows = 16;     ///< over perceptual roughness r

/// Where y in [-1,1] and r in [0,1] are in the table, in texels from the middle of the first: lookups are bilinear
/// between texels' middles.
///   row = 15 r^0.55;  column = 31.5 + sign(y) (0.5 + 31 |y|^p), p = 0.3 + 0.4 r.
/// Columns 31 and 32 are both the horizon, where a smooth sky has a kink, so that neither side sees the other's slope.
/// The powers were chosen by measurement: near the horizon and r = 0 the light is a homogeneous function of |y|^0.4 and
/// r^0.8, which no grid of cells can follow at its corner, only smaller ones; at r = 1 what is wanted are even steps.
/// The largest errors of a lookup (every colour, y and r): 0.42 % so; 1.0 % with p = 0.4 and r^0.8, which make each
/// edge of the table exact; 0.56 % at best with a power of |y| that does not depend on r.
template <std::floating_point T>
[[nodiscard]] T sky_row(T roughness) noexcept {
    return T(sky_rows - 1) * std::pow(std::clamp(roughness, T(0), T(1)), T(0.55));
}
/// The column of the table for a height and a roughness.
template <std::floating_point T>
[[nodiscard]] T sky_column(T y, T roughness) noexcept {
    const T power = T(0.3) + T(0.4) * std::clamp(roughness, T(0), T(1));
    const T sign = y > T(0) ? T(1) : y < T(0) ? T(-1) : T(0);
    return T(0.5 * (sky_columns - 1)) +
           sign * (T(0.5) + T(sky_columns / 2 - 1) * std::pow(std::min(std::abs(y), T(1)), power));
}

/// `[16, 64, 3]`: the sky's radiance prefiltered by the GGX lobe of each row's roughness around a reflected ray whose
/// upward component is the column's y, with N = V = R and samples weighted by N·L (the first factor of the split sum,
/// Karis 2013).  Row 0 is the sky itself.  Row 15 is also E(n)/π, what a white perfect diffuser of normal n returns: at
/// α = 1, D is 1/π and the lobe is the cosine.
/// Made by Gauss rules split at the horizon; within 0.01 % of converged integrals at each texel.
[[nodiscard]] ImageF make_sky_table(const Sky& sky = {});

/// One value of it in double, within 0.01 % of the integral: y in [-1,1], roughness in [0,1].
[[nodiscard]] glm::dvec3 prefiltered_sky(const Sky& sky, double y, double roughness);

/// The table's lookup on the CPU, as a shader does it.  With `roughness` 1 and y of a normal: diffuse light.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> sample_sky_table(const ImageF& table, T y, T roughness) noexcept {
    const T column = sky_column(y, roughness), row = sky_row(roughness);
    const auto left = static_cast<std::uint32_t>(std::min(column, T(sky_columns - 2)));
    const auto top = static_cast<std::uint32_t>(std::min(row, T(sky_rows - 2)));
    const T fx = column - T(left), fy = row - T(top);
    const auto texel = [&](std::uint32_t i, std::uint32_t j) {
        const float* t = table.texel(left + i, top + j);
        return glm::vec<3, T>(T(t[0]), T(t[1]), T(t[2]));
    };
    return (texel(0, 0) * (T(1) - fx) + texel(1, 0) * fx) * (T(1) - fy) +
           (texel(0, 1) * (T(1) - fx) + texel(1, 1) * fx) * fy;
}

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/sky-inl.hpp>
#endif
