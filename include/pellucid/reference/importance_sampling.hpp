// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How a compute shader prefilters an environment: points of a sequence, half vectors of the GGX lobe, and a level of
/// the source's mip chain for each sample.  Templates on the floating type: `double` is the reference, `float` is what
/// a shader computes.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <pellucid/reference/environment.hpp>

namespace pellucid::inline v0_1::reference {

/// The i-th of n points of the Hammersley set in [0,1)²: ((i + 1/2)/n, the bits of i mirrored at the binary point).
/// 24 bits are kept, so that float and double have the same second coordinate, and it is below 1.
/// Precondition: i < n <= 2^24.
template <std::floating_point T>
[[nodiscard]] glm::vec<2, T> hammersley(std::uint32_t i, std::uint32_t n) noexcept {
    std::uint32_t bits = i;
    bits = bits << 16u | bits >> 16u;
    bits = (bits & 0x00FF00FFu) << 8u | (bits & 0xFF00FF00u) >> 8u;
    bits = (bits & 0x0F0F0F0Fu) << 4u | (bits & 0xF0F0F0F0u) >> 4u;
    bits = (bits & 0x33333333u) << 2u | (bits & 0xCCCCCCCCu) >> 2u;
    bits = (bits & 0x55555555u) << 1u | (bits & 0xAAAAAAAAu) >> 1u;
    return {(T(i) + T(0.5)) / T(n), T(bits >> 8u) * T(0x1p-24)};
}

/// A half vector around +z whose density is D(H)(N·H) [1/sr] (Walter et al. 2007): tan²θ = α² x/(1 − x), φ = 2π y.
/// Precondition: u.x in [0,1).
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> sample_ggx(glm::vec<2, T> u, T alpha) noexcept {
    const T tangent = alpha * std::sqrt(u.x / (T(1) - u.x)), phi = T(2) * std::numbers::pi_v<T> * u.y;
    const T cosine = T(1) / std::sqrt(T(1) + tangent * tangent), sine = tangent * cosine;
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// The share of the lobe's half vectors within 45° of N, those that reflect N to above the horizon: x < 1/(1 + α²).
template <std::floating_point T>
[[nodiscard]] T ggx_share_above(T alpha) noexcept {
    return T(1) / (T(1) + alpha * alpha);
}

/// The density [1/sr] of L = reflect(−N, H) by solid angle, V = N, where all half vectors are within 45°:
/// D(H)/4 / ggx_share_above.  `sine2` is |N×H|².
template <std::floating_point T>
[[nodiscard]] T reflected_density(T sine2, T alpha) noexcept {
    const T a2 = alpha * alpha, q = sine2 + (T(1) - sine2) * a2, ratio = alpha / q;
    return ratio * ratio / (T(4) * std::numbers::pi_v<T>)*(T(1) + a2);
}

/// The level whose texels are as large as a sample's share of the sphere (Křivánek and Colbert 2008, equation 12;
/// texels are taken to be all of one size): max(1/2 log2(texels/(4π samples density)) + bias, 0).  They recommend a
/// bias of 1.  Measured on a sunlit picture: 0 is best with 256 samples, 1/2 with 1024, 1 with 4096; on a smooth sky 0.
template <std::floating_point T>
[[nodiscard]] T filtered_lod(T density, T samples, T texels, T bias) noexcept {
    return std::max(T(0.5) * std::log2(texels / (T(4) * std::numbers::pi_v<T> * samples * density)) + bias, T(0));
}

inline constexpr double prefilter_lod_bias = 0.5;

/// The GGX-prefiltered radiance around `axis` from `samples` lookups, Σ radiance(l, lod) N·L / Σ N·L.  `radiance` is
/// called with a unit direction and a level for a chain that has `texels` texels in level 0 over the sphere.
/// α in (0,1].  Every sample is above the horizon.
template <std::floating_point T, class Radiance>
[[nodiscard]] glm::vec<3, T> prefilter_sampled(const Radiance& radiance, glm::vec<3, T> axis, T alpha,
                                               std::uint32_t samples, T texels, T bias = T(prefilter_lod_bias)) {
    const BasicFrame<T> frame(axis);
    const T share = ggx_share_above(alpha);
    glm::vec<3, T> sum(T(0));
    T total = T(0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        glm::vec<2, T> u = hammersley<T>(i, samples);
        u.x *= share;
        const glm::vec<3, T> h = sample_ggx(u, alpha);
        const T sine2 = h.x * h.x + h.y * h.y, cosine = T(1) - T(2) * sine2;  // N·L = 2 (N·H)² − 1
        if (!(cosine > T(0))) continue;                                       // rounding at 45°
        const T lod = filtered_lod(reflected_density(sine2, alpha), T(samples), texels, bias);
        const glm::vec<3, T> l = frame.to_world({T(2) * h.z * h.x, T(2) * h.z * h.y, cosine});
        sum += radiance(l, lod) * cosine;
        total += cosine;
    }
    return sum / total;
}

}  // namespace pellucid::inline v0_1::reference
