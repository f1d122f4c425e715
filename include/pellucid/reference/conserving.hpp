// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The reflection model that neither loses nor makes energy: glTF's specular lobe; a second lobe for light that is
/// reflected more than once between microfacets (Kulla and Conty 2017); and a diffuse part that shares out what both
/// leave (the form of Kelemen and Szirmay-Kalos 2001).  All three are reciprocal.  Every colour channel apart:
///     specular:  D V F + F_ms (1 − E(μv))(1 − E(μl)) / (π (1 − E_avg))
///     diffuse:   (1 − metallic) base (1 − E_s(μv))(1 − E_s(μl)) / (π (1 − E_s,avg))
/// with E the albedo of a white lobe (F0 = 1), E_s(μ) = F0 scale + bias + F_ms (1 − E(μ)) that of the first two.
/// A surface under a white environment returns E_s + (1 − E_s)(1 − metallic) base: 1 where F0 is 1, and 1 where base is
/// 1 and metallic 0, at any roughness and view.  The limits are those of the table: 6e-4 for 128².
///
/// F_ms = F̄² E_avg/(1 − F̄ (1 − E_avg)), F̄ = F0 + (1 − F0)/21, the cosine-weighted mean of Schlick's term.  By a random
/// walk on the microsurface (Heitz et al. 2016; tests/reference/conserving.cpp) for F0 from 0.04 to 0.95, roughness
/// 0.25 to 1, the albedo E_s is off by 0.009 in the mean and 0.044 at most; with F̄ = the mean over the lobe 0.011 and
/// 0.052; with F̄ in place of F̄², as in the first publication, 0.019 and 0.086; without the second lobe 0.096 and 0.60.
#include <pellucid/reference/brdf_terms.hpp>
#include <pellucid/reference/dfg_table.hpp>

namespace pellucid::inline v0_1::reference {

/// What of a surface and an eye is the same for all lights.
template <std::floating_point T = double>
struct ConservingView {
    glm::vec<3, T> f0{T(0)};               ///< reflectance at normal incidence
    glm::vec<3, T> between{T(0)};          ///< F_ms
    glm::vec<3, T> diffuse{T(0)};          ///< (1 − metallic) base (1 − E_s(μv)) / (π (1 − E_s,avg))
    glm::vec<3, T> specular_albedo{T(0)};  ///< E_s(μv)
    T roughness = T(1);                    ///< that of the table
    T loss = T(0);                         ///< (1 − E(μv)) / (π (1 − E_avg))
};

/// F_ms of the file's comment.  `average`: of the table, at the surface's roughness.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> multiple_scattering(glm::vec<3, T> f0, const Dfg<T>& average) noexcept;

/// E_s = F0 scale + bias + F_ms loss.  `dfg`: at some μ, or the average.  Exactly 1 where F0 and F_ms are 1.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> conserving_albedo(glm::vec<3, T> f0, glm::vec<3, T> between, const Dfg<T>& dfg) noexcept;

/// `roughness`: what the lobe really has, `punctual_alpha`'s under punctual lights.
template <std::floating_point T>
[[nodiscard]] ConservingView<T> conserving_view(const Surface<T>& surface, T n_dot_v, T roughness,
                                                const DfgTable& table) noexcept;

/// The response to a punctual light: roughness from 0.045 on, |N·V| for N·V.  Where V + L = 0 it is 0, as glTF's.
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> evaluate_conserving(const Surface<T>& surface, glm::vec<3, T> to_eye,
                                                  glm::vec<3, T> to_light, const DfgTable& table) noexcept;

/// What the surface returns of an environment that has the same radiance everywhere, as a factor of that radiance: the
/// closed form of the integral of the response over all lights, the roughness as it is.  `n_dot_v` in [0,1].
template <std::floating_point T>
[[nodiscard]] BrdfResponse<T> constant_environment_response(const Surface<T>& surface, T n_dot_v,
                                                            const DfgTable& table) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

template <std::floating_point T>
glm::vec<3, T> multiple_scattering(glm::vec<3, T> f0, const Dfg<T>& average) noexcept {
    const glm::vec<3, T> mean = f0 + (glm::vec<3, T>(T(1)) - f0) / T(21);
    return mean * mean * (T(1) - average.loss) / (glm::vec<3, T>(T(1)) - mean * average.loss);
}

template <std::floating_point T>
glm::vec<3, T> conserving_albedo(glm::vec<3, T> f0, glm::vec<3, T> between, const Dfg<T>& dfg) noexcept {
    return f0 * (T(1) - dfg.loss) + (glm::vec<3, T>(T(1)) - f0) * dfg.bias + between * dfg.loss;
}

template <std::floating_point T>
ConservingView<T> conserving_view(const Surface<T>& surface, T n_dot_v, T roughness, const DfgTable& table) noexcept {
    const T pi = std::numbers::pi_v<T>;
    const T least = T(1e-6);  // where so little is left, the eye's and the light's shares are as little
    const Dfg<T> eye = table.lookup(n_dot_v, roughness), average = table.average(roughness);
    ConservingView<T> out;
    out.f0 = normal_reflectance(surface);
    out.between = multiple_scattering(out.f0, average);
    out.specular_albedo = conserving_albedo(out.f0, out.between, eye);
    out.roughness = roughness;
    out.loss = average.loss > T(0) ? eye.loss / (pi * average.loss) : T(0);
    const glm::vec<3, T> left = glm::vec<3, T>(T(1)) - out.specular_albedo;
    const glm::vec<3, T> average_left = glm::vec<3, T>(T(1)) - conserving_albedo(out.f0, out.between, average);
    for (int c = 0; c < 3; ++c)
        out.diffuse[c] = (T(1) - surface.metallic) * surface.base_color[c] * std::max(left[c], T(0)) /
                         (pi * std::max(average_left[c], least));
    return out;
}

template <std::floating_point T>
BrdfResponse<T> evaluate_conserving(const Surface<T>& surface, glm::vec<3, T> to_eye, glm::vec<3, T> to_light,
                                    const DfgTable& table) noexcept {
    const T n_dot_l = std::min(glm::dot(surface.normal, to_light), T(1));
    if (!(n_dot_l > T(0))) return {};
    const glm::vec<3, T> half = to_eye + to_light;
    const T half2 = glm::dot(half, half);
    if (half2 < T(min_half_vector2)) return {};
    const T n_dot_v = std::min(std::abs(glm::dot(surface.normal, to_eye)), T(1));
    const T alpha = punctual_alpha(surface.roughness);
    const ConservingView<T> view = conserving_view(surface, n_dot_v, std::sqrt(alpha), table);
    const glm::vec<3, T> fresnel = schlick_fresnel(view.f0, glm::dot(to_eye, half) / std::sqrt(half2));
    const T lobe = ggx_distribution(surface.normal, half, alpha) * smith_visibility(n_dot_v, n_dot_l, alpha) * n_dot_l;
    const Dfg<T> light = table.lookup(n_dot_l, view.roughness);
    glm::vec<3, T> left = glm::vec<3, T>(T(1)) - conserving_albedo(view.f0, view.between, light);
    for (int c = 0; c < 3; ++c) left[c] = std::max(left[c], T(0));
    return {view.diffuse * left * n_dot_l, fresnel * lobe + view.between * (view.loss * light.loss * n_dot_l)};
}

template <std::floating_point T>
BrdfResponse<T> constant_environment_response(const Surface<T>& surface, T n_dot_v, const DfgTable& table) noexcept {
    const ConservingView<T> view = conserving_view(surface, n_dot_v, surface.roughness, table);
    const glm::vec<3, T> left = glm::vec<3, T>(T(1)) - view.specular_albedo;
    return {left * surface.base_color * (T(1) - surface.metallic), view.specular_albedo};
}

}  // namespace pellucid::inline v0_1::reference
