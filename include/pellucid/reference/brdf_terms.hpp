// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the reflection models are made of: the surface, the GGX distribution, Smith's visibility, Schlick's Fresnel
/// term, with every guard written out.  Templates on the floating type: `double` is the reference, `float` shows what
/// the arithmetic of a shader loses.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace pellucid::inline v0_1::reference {

/// What a point of an opaque surface reflects.
template <std::floating_point T = double>
struct Surface {
    glm::vec<3, T> normal{T(0), T(0), T(1)};      ///< unit, world axes
    glm::vec<3, T> base_color{T(1), T(1), T(1)};  ///< linear, each in [0,1]
    T metallic = T(0);                            ///< [0,1]
    T roughness = T(1);                           ///< [0,1] perceptual
    T occlusion = T(1);                           ///< [0,1] dims ambient light only
    glm::vec<3, T> emissive{T(0), T(0), T(0)};    ///< [cd/m²]
};

/// The two parts of a response, each times N·L [1/sr].
template <std::floating_point T = double>
struct BrdfResponse {
    glm::vec<3, T> diffuse{T(0), T(0), T(0)};
    glm::vec<3, T> specular{T(0), T(0), T(0)};
    [[nodiscard]] glm::vec<3, T> total() const noexcept { return diffuse + specular; }
};

/// Smallest perceptual roughness under punctual lights (α = 2.025e-3, peak of D 7.8e4 /sr).  A punctual light on a
/// smoother surface has a highlight smaller than any pixel; this width stands for the light's own size.  Only α is
/// limited, never D.  Area and environment lights do not use it.
inline constexpr double min_punctual_roughness = 0.045;

/// Squared length of V + L below which there is no half vector: L points away from the eye's side, along the view.
inline constexpr double min_half_vector2 = 1e-12;

/// α of the model under punctual lights: max(roughness, 0.045)².  NaN gives the smallest α.
template <std::floating_point T>
[[nodiscard]] T punctual_alpha(T roughness) noexcept;

/// Cross product whose components are correct to 1.5 ulp each also where their two products cancel (Kahan's difference
/// of products: two fused multiply-adds).
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> accurate_cross(glm::vec<3, T> a, glm::vec<3, T> b) noexcept;

/// The GGX distribution (Trowbridge and Reitz 1975, Walter et al. 2007) in a form without cancellation (Lagrange's
/// identity, 1 − (N·H)² = |N×H|²): q = |N×H|² + (N·H α)², D = (α/q)²/π [1/sr].
/// `half` need not be a unit vector: V + L will do.  Precondition: |half|² > 0.  α is 0 or in [1e-15,1]; α = 0 is a
/// mirror whose D is a delta, and gives 0.
/// In float, for the half vector as given, the relative error is at most 1e-6 at any roughness (with a plain cross
/// product 4e-5 at roughness 0.045 and 5e-3 at 1/255).  Rounding V + L costs 6e-5 and 7e-3 there.
template <std::floating_point T>
[[nodiscard]] T ggx_distribution(glm::vec<3, T> normal, glm::vec<3, T> half, T alpha) noexcept;

/// Height-correlated Smith masking and shadowing over its denominator (Heitz 2014):
/// V = G₂/(4 N·L N·V) = ½ / (N·L √((N·V − α²N·V)N·V + α²) + N·V √((N·L − α²N·L)N·L + α²)).
/// Precondition: both cosines in [0,1].  0 where the denominator is 0 (only when N·L = 0, or α = 0).
template <std::floating_point T>
[[nodiscard]] T smith_visibility(T n_dot_v, T n_dot_l, T alpha) noexcept;

/// Schlick's Fresnel term: F0 + (1 − F0) x⁵, x = 1 − V·H limited to [0,1].
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> schlick_fresnel(glm::vec<3, T> f0, T v_dot_h) noexcept;

/// Reflectance at normal incidence: 0.04 + (base − 0.04) metallic.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> normal_reflectance(const Surface<T>& surface) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

template <std::floating_point T>
T punctual_alpha(T roughness) noexcept {
    const T limited = roughness > T(min_punctual_roughness) ? roughness : T(min_punctual_roughness);
    return limited * limited;
}

template <std::floating_point T>
glm::vec<3, T> accurate_cross(glm::vec<3, T> a, glm::vec<3, T> b) noexcept {
    const auto difference = [](T p, T q, T r, T s) {  // p q − r s
        const T product = r * s;
        const T lost = std::fma(-r, s, product);
        return std::fma(p, q, -product) + lost;
    };
    return {difference(a.y, b.z, a.z, b.y), difference(a.z, b.x, a.x, b.z), difference(a.x, b.y, a.y, b.x)};
}

template <std::floating_point T>
T ggx_distribution(glm::vec<3, T> normal, glm::vec<3, T> half, T alpha) noexcept {
    const glm::vec<3, T> c = accurate_cross(normal, half);
    const T scaled = glm::dot(normal, half) * alpha;
    const T q = (glm::dot(c, c) + scaled * scaled) / glm::dot(half, half);
    if (!(q > T(0))) return T(0);
    const T ratio = alpha / q;
    return ratio * ratio / std::numbers::pi_v<T>;
}

template <std::floating_point T>
T smith_visibility(T n_dot_v, T n_dot_l, T alpha) noexcept {
    const T a2 = alpha * alpha;
    const T toward_eye = n_dot_l * std::sqrt((n_dot_v - a2 * n_dot_v) * n_dot_v + a2);
    const T toward_light = n_dot_v * std::sqrt((n_dot_l - a2 * n_dot_l) * n_dot_l + a2);
    const T sum = toward_eye + toward_light;
    return sum > T(0) ? T(0.5) / sum : T(0);
}

template <std::floating_point T>
glm::vec<3, T> schlick_fresnel(glm::vec<3, T> f0, T v_dot_h) noexcept {
    const T x = std::clamp(T(1) - v_dot_h, T(0), T(1));
    const T x2 = x * x;
    const T x5 = x2 * x2 * x;
    return f0 + (glm::vec<3, T>(T(1)) - f0) * x5;
}

template <std::floating_point T>
glm::vec<3, T> normal_reflectance(const Surface<T>& surface) noexcept {
    const glm::vec<3, T> dielectric(T(0.04));
    return dielectric + (surface.base_color - dielectric) * surface.metallic;
}

}  // namespace pellucid::inline v0_1::reference
