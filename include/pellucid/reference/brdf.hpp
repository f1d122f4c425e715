// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The reflection models of an opaque surface, from their formulae, with every guard written out.  Templates on the
/// floating type: `double` is the reference, `float` shows what the arithmetic of a shader loses.  Their common terms
/// are in brdf_terms.hpp, the model that loses no energy in conserving.hpp.
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
#include <pellucid/reference/brdf_terms.hpp>
#include <pellucid/reference/conserving.hpp>

namespace pellucid::inline v0_1::reference {

/// `gltf`: Appendix B of glTF 2.0.  `seed`: Schlick's masking with k = (r+1)²/8, and biased denominators; kept to be
/// measured.  `blinn_phong`: the power-law highlight, for comparison.  `conserving`: glTF's highlight, what it loses
/// between microfacets, and a diffuse part that takes what is left.
enum class BrdfModel : std::uint8_t { gltf, seed, blinn_phong, conserving };

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

/// The response by `model`.  `table` is read by `conserving` alone.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_brdf(BrdfModel model, const Surface<T>& surface, glm::vec<3, T> to_eye,
                                            glm::vec<3, T> to_light, const DfgTable& table) noexcept {
    if (model == BrdfModel::seed) return evaluate_seed(surface, to_eye, to_light);
    if (model == BrdfModel::blinn_phong) return evaluate_blinn_phong(surface, to_eye, to_light);
    if (model == BrdfModel::conserving) return evaluate_conserving(surface, to_eye, to_light, table);
    return evaluate_gltf(surface, to_eye, to_light);
}

/// The same with `reference_dfg_table()`, which the first `conserving` call of a process makes.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_brdf(BrdfModel model, const Surface<T>& surface, glm::vec<3, T> to_eye,
                                            glm::vec<3, T> to_light) noexcept {
    if (model == BrdfModel::conserving) return evaluate_conserving(surface, to_eye, to_light, reference_dfg_table());
    return evaluate_brdf(model, surface, to_eye, to_light, DfgTable{});
}

// ---------------------------------------------------------------------------------------------------- bodies

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

}  // namespace pellucid::inline v0_1::reference
