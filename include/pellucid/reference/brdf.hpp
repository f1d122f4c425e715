// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The reflection models of an opaque surface, from their formulae, with every guard written out.  Templates on the
/// floating type: `double` is the reference, `float` shows what the arithmetic of a shader loses.
///
/// Shared by all models: N, V (to the eye) and L (to the light) are unit vectors; a response is f(V,L)·(N·L) in 1/sr,
/// to be multiplied by the light's irradiance at normal incidence; N·L <= 0 gives exactly 0; α = roughness².
///
/// N·V < 0 happens where an interpolated or mapped normal turns away from the eye.  There |N·V| stands in for N·V and
/// D is even in N·H (the usual step function at N·H = 0 is left out, since N·L > 0 and N·V > 0 imply N·H > 0), so the
/// response stays finite, positive and continuous.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>

namespace pellucid::reference {

/// `gltf`: Appendix B of glTF 2.0.  `seed`: Schlick's masking with k = (r+1)²/8, and biased denominators; kept to be
/// measured.  `blinn_phong`: the power-law highlight, for comparison.
enum class BrdfModel : std::uint8_t { gltf, seed, blinn_phong };

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

/// Appendix B of glTF 2.0: specular = D V F (N·L), diffuse = (1 − F)(1 − metallic) base/π (N·L).
/// Where V + L = 0 (|V+L|² < 1e-12): V·H is 0, so F is 1 and all is 0.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_gltf(const Surface<T>& surface, glm::vec<3, T> to_eye,
                                            glm::vec<3, T> to_light) noexcept;

// The seed's terms, operation by operation, without guards.
/// α²/(π (NoH²(α²−1)+1)²).  0/0 for roughness 0 on the axis; in float, infinite on the axis below roughness 0.0131.
template <std::floating_point T>
[[nodiscard]] T seed_distribution(T n_dot_h, T roughness) noexcept;
/// NoX/(NoX(1−k)+k), k = (roughness+1)²/8.
template <std::floating_point T>
[[nodiscard]] T seed_masking(T n_dot_x, T roughness) noexcept;

/// The seed's model: D G F/(4 N·V N·L + 1e-4), G = product of two maskings, cosines limited to [0,1] (N·V too), F with
/// H·V, diffuse = (1 − F)(1 − metallic) base/π.  Roughness is not limited.  The two inputs where it is 0/0 (roughness
/// 0 with N = H, and V + L = 0) give specular 0 here and F as for V·H = 0.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_seed(const Surface<T>& surface, glm::vec<3, T> to_eye,
                                            glm::vec<3, T> to_light) noexcept;

/// Blinn–Phong in radiometric units: diffuse = (1 − metallic) base/π (N·L), specular = F0 (s+2)/(8π) (N·H)^s (N·L),
/// s = 2/α² − 2 with α from `punctual_alpha`.  (s+2)/(2π) (N·H)^s is then a normalised distribution whose peak,
/// 1/(πα²), is that of GGX; the 1/4 left is masking by N·L N·V.  No Fresnel term, diffuse keeps its full share.
/// Specular is 0 where N·H <= 0 or V + L = 0.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_blinn_phong(const Surface<T>& surface, glm::vec<3, T> to_eye,
                                                   glm::vec<3, T> to_light) noexcept;

/// The response by `model`.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_brdf(BrdfModel model, const Surface<T>& surface, glm::vec<3, T> to_eye,
                                            glm::vec<3, T> to_light) noexcept {
    if (model == BrdfModel::seed) return evaluate_seed(surface, to_eye, to_light);
    if (model == BrdfModel::blinn_phong) return evaluate_blinn_phong(surface, to_eye, to_light);
    return evaluate_gltf(surface, to_eye, to_light);
}

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

template <std::floating_point T>
BrdfResponse<T> evaluate_gltf(const Surface<T>& surface, glm::vec<3, T> to_eye, glm::vec<3, T> to_light) noexcept {
    const T n_dot_l = std::min(glm::dot(surface.normal, to_light), T(1));
    if (!(n_dot_l > T(0))) return {};
    const glm::vec<3, T> half = to_eye + to_light;
    const T half2 = glm::dot(half, half);
    if (half2 < T(min_half_vector2)) return {};
    const T n_dot_v = std::min(std::abs(glm::dot(surface.normal, to_eye)), T(1));
    const T alpha = punctual_alpha(surface.roughness);
    const glm::vec<3, T> fresnel =
        schlick_fresnel(normal_reflectance(surface), glm::dot(to_eye, half) / std::sqrt(half2));
    const T lobe = ggx_distribution(surface.normal, half, alpha) * smith_visibility(n_dot_v, n_dot_l, alpha) * n_dot_l;
    const T lambert = (T(1) - surface.metallic) * n_dot_l / std::numbers::pi_v<T>;
    return {(glm::vec<3, T>(T(1)) - fresnel) * surface.base_color * lambert, fresnel * lobe};
}

template <std::floating_point T>
T seed_distribution(T n_dot_h, T roughness) noexcept {
    const T a = roughness * roughness;
    const T a2 = a * a;
    const T inner = n_dot_h * n_dot_h * (a2 - T(1)) + T(1);
    return a2 / (std::numbers::pi_v<T> * inner * inner);
}

template <std::floating_point T>
T seed_masking(T n_dot_x, T roughness) noexcept {
    const T r = roughness + T(1);
    const T k = r * r / T(8);
    return n_dot_x / (n_dot_x * (T(1) - k) + k);
}

template <std::floating_point T>
BrdfResponse<T> evaluate_seed(const Surface<T>& surface, glm::vec<3, T> to_eye, glm::vec<3, T> to_light) noexcept {
    const T n_dot_l = std::max(glm::dot(surface.normal, to_light), T(0));
    if (!(n_dot_l > T(0))) return {};
    const T n_dot_v = std::max(glm::dot(surface.normal, to_eye), T(0));
    const glm::vec<3, T> sum = to_eye + to_light;
    const bool has_half = glm::dot(sum, sum) >= T(min_half_vector2);
    const glm::vec<3, T> half = has_half ? glm::normalize(sum) : glm::vec<3, T>(T(0));
    const glm::vec<3, T> fresnel = schlick_fresnel(normal_reflectance(surface), std::max(glm::dot(half, to_eye), T(0)));
    T lobe = seed_distribution(std::max(glm::dot(surface.normal, half), T(0)), surface.roughness) *
             seed_masking(n_dot_v, surface.roughness) * seed_masking(n_dot_l, surface.roughness) /
             (T(4) * n_dot_v * n_dot_l + T(0.0001));
    if (!has_half || !std::isfinite(lobe)) lobe = T(0);
    const T lambert = (T(1) - surface.metallic) * n_dot_l / std::numbers::pi_v<T>;
    return {(glm::vec<3, T>(T(1)) - fresnel) * surface.base_color * lambert, fresnel * (lobe * n_dot_l)};
}

template <std::floating_point T>
BrdfResponse<T> evaluate_blinn_phong(const Surface<T>& surface, glm::vec<3, T> to_eye,
                                     glm::vec<3, T> to_light) noexcept {
    const T n_dot_l = std::min(glm::dot(surface.normal, to_light), T(1));
    if (!(n_dot_l > T(0))) return {};
    BrdfResponse<T> response;
    response.diffuse = surface.base_color * ((T(1) - surface.metallic) * n_dot_l / std::numbers::pi_v<T>);
    const glm::vec<3, T> half = to_eye + to_light;
    const T half2 = glm::dot(half, half);
    if (half2 < T(min_half_vector2) || !(glm::dot(surface.normal, half) > T(0))) return response;
    const T alpha = punctual_alpha(surface.roughness);
    const T exponent = T(2) / (alpha * alpha) - T(2);
    // (N·H)^s = exp(s/2 · log(1 − |N×H|²)): near the axis N·H itself has no digits left for a large s.
    const glm::vec<3, T> c = accurate_cross(surface.normal, half);
    const T sin2 = std::min(glm::dot(c, c) / half2, T(1) - std::numeric_limits<T>::epsilon());
    const T power = std::exp(T(0.5) * exponent * std::log1p(-sin2));
    response.specular =
        normal_reflectance(surface) * ((exponent + T(2)) / (T(8) * std::numbers::pi_v<T>)*power * n_dot_l);
    return response;
}

}  // namespace pellucid::reference
