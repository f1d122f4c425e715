// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Terms of reflection models and the approximations of them that renderers use, each from its published formula, and
/// what the loop of shaders/bench_brdf evaluates.
#include <bench_brdf/parameters.h>
#include <pellucid/reference/furnace.hpp>

namespace pellucid::bench {

using reference::Dfg;
using reference::DfgTable;

// ------------------------------------------------------------------------- D of the unit normal and V + L, in float
/// NoH²(α² − 1) + 1 in the denominator, as in the seed, Granite, Donut and glTF-Sample-Viewer.
template <std::floating_point T>
[[nodiscard]] T d_seed(glm::vec<3, T> n, glm::vec<3, T> h, T alpha) {
    return reference::seed_distribution(std::max(glm::dot(n, glm::normalize(h)), T(0)), std::sqrt(alpha));
}
/// (α/(1 − NoH² + (NoH α)²))²/π, as in Filament on desktops, Godot and Bevy.
template <std::floating_point T>
[[nodiscard]] T d_complement(glm::vec<3, T> n, glm::vec<3, T> h, T alpha) {
    const T n_h = glm::dot(n, glm::normalize(h)), a = n_h * alpha;
    const T k = alpha / (T(1) - n_h * n_h + a * a);
    return k * k / std::numbers::pi_v<T>;
}
/// (α/(|N×H|² + (NoH α)²))²/π with a plain cross product, as shaders/common/brdf.glsl has it.
template <std::floating_point T>
[[nodiscard]] T d_lagrange(glm::vec<3, T> n, glm::vec<3, T> h, T alpha) {
    const glm::vec<3, T> c = glm::cross(n, h);
    const T scaled = glm::dot(n, h) * alpha;
    const T ratio = alpha * glm::dot(h, h) / (glm::dot(c, c) + scaled * scaled);
    return ratio * ratio / std::numbers::pi_v<T>;
}

// ------------------------------------------------------------------------- V
/// 0.5/lerp(2 NoL NoV, NoL + NoV, α) (Hammon 2017).
[[nodiscard]] inline double v_hammon(double n_v, double n_l, double alpha) {
    return 0.5 / std::lerp(2 * n_l * n_v, n_l + n_v, alpha);
}
/// The product of two Smith maskings, each over 2 NoX.
[[nodiscard]] inline double v_uncorrelated(double n_v, double n_l, double alpha) {
    const double a2 = alpha * alpha;
    const auto one = [a2](double x) { return 1 / (x + std::sqrt(x * x * (1 - a2) + a2)); };
    return one(n_v) * one(n_l);
}
/// Schlick's masking, NoX/(NoX (1 − k) + k), twice; k = α/2 or, as the seed has it, (roughness + 1)²/8.
[[nodiscard]] inline double v_schlick(double n_v, double n_l, double k) {
    return 0.25 / ((n_v * (1 - k) + k) * (n_l * (1 - k) + k));
}
[[nodiscard]] inline double seed_k(double roughness) {
    return (roughness + 1) * (roughness + 1) / 8;
}

// ------------------------------------------------------------------------- E
[[nodiscard]] inline Dfg<double> dfg_of(double scale, double bias) {
    return {1 - scale - bias, bias};
}
/// Karis 2014, "Physically based shading on mobile".
[[nodiscard]] inline Dfg<double> e_karis(double mu, double roughness) {
    const double x = 1 - roughness, y = 0.0425 - 0.0275 * roughness;
    const double a = std::min(x * x, std::exp2(-9.28 * mu)) * x + y;
    return dfg_of(1.04 - 0.572 * roughness - 1.04 * a, 0.022 * roughness - 0.04 + 1.04 * a);
}
/// Lazarov 2013, with Narkowicz's coefficients for GGX (2014); gloss = 1 − roughness.
[[nodiscard]] inline Dfg<double> e_lazarov(double mu, double roughness) {
    const double g = 1 - roughness;
    const double rise = std::min(1.548 * g - 0.2511, std::exp2(-7.672 * mu));
    const double bias = std::clamp((0.5745 * g + 0.5753) * rise - 0.02397 * g - 0.02066, 0.0, 1.0);
    return dfg_of(std::clamp(1.301 * g + 0.4755, 0.0, 1.0) - bias, bias);
}
/// Narkowicz 2014: two polynomials; gloss = 1 − roughness.
[[nodiscard]] inline Dfg<double> e_polynomial(double mu, double roughness) {
    const double x = 1 - roughness, y = mu;
    const double bias = std::clamp(
        std::min(-0.1688 * x + 1.895 * x * x, 0.9903 - 4.853 * y + 8.404 * y * y - 5.069 * y * y * y), 0.0, 1.0);
    const double delta = std::clamp(
        0.6045 + 1.699 * x - 0.5228 * y - 3.603 * x * x + 1.404 * x * y + 0.1939 * y * y + 2.661 * x * x * x, 0.0, 1.0);
    return dfg_of(delta - bias, bias);
}
/// Zioma 2015: F0 + (1 − max(roughness, μ))³.
[[nodiscard]] inline Dfg<double> e_cube(double mu, double roughness) {
    const double x = 1 - std::max(roughness, mu);
    return dfg_of(1, x * x * x);
}

// ------------------------------------------------------------------------- the loop's terms in double
inline constexpr glm::dvec3 loop_normal{0.48, 0.6, 0.64};

[[nodiscard]] inline Dfg<double> loop_albedo(std::uint32_t term, double mu, double roughness, const DfgTable& table) {
    switch (term) {
        case BENCH_BRDF_E_QUADRATURE:
            return reference::sampled_dfg(mu, roughness * roughness, 128);
        case BENCH_BRDF_E_TABLE:
            return table.lookup(mu, roughness);
        case BENCH_BRDF_E_KARIS:
            return e_karis(mu, roughness);
        case BENCH_BRDF_E_LAZAROV:
            return e_lazarov(mu, roughness);
        case BENCH_BRDF_E_POLYNOMIAL:
            return e_polynomial(mu, roughness);
        case BENCH_BRDF_E_CUBE:
            return e_cube(mu, roughness);
        default:
            return {mu, roughness};
    }
}

/// What shaders/bench_brdf/term.comp evaluates for the inputs `u`, each in [0,1).
[[nodiscard]] inline double loop_term(std::uint32_t term, glm::dvec3 u, const DfgTable& table) {
    const glm::dvec3 n = loop_normal;
    if (term < BENCH_BRDF_V_INPUTS) {
        const glm::dvec3 h = n + glm::dvec3(u.x - 0.5, u.y - 0.5, 0);
        const double alpha = 0.1 + 0.9 * u.z;
        if (term == BENCH_BRDF_D_INPUTS) return h.x + h.y + h.z + alpha;
        return reference::ggx_distribution(n, h, alpha);  // of which all forms are forms
    }
    if (term < BENCH_BRDF_E_INPUTS) {
        const double n_v = 0.02 + 0.98 * u.x, n_l = 0.02 + 0.98 * u.y, alpha = 0.01 + 0.99 * u.z;
        switch (term) {
            case BENCH_BRDF_V_EXACT:
                return reference::smith_visibility(n_v, n_l, alpha);
            case BENCH_BRDF_V_HAMMON:
                return v_hammon(n_v, n_l, alpha);
            case BENCH_BRDF_V_UNCORRELATED:
                return v_uncorrelated(n_v, n_l, alpha);
            case BENCH_BRDF_V_SCHLICK:
                return v_schlick(n_v, n_l, 0.5 * alpha);
            case BENCH_BRDF_V_SEED:
                return v_schlick(n_v, n_l, seed_k(alpha));
            default:
                return n_v + n_l + alpha;
        }
    }
    if (term < BENCH_BRDF_MODEL_INPUTS) return loop_albedo(term, u.x, 0.01 + 0.99 * u.y, table).albedo(u.z);
    const glm::dvec3 v = glm::normalize(n + glm::dvec3(u.x - 0.5, u.y - 0.5, 0));
    const glm::dvec3 l = glm::normalize(n + glm::dvec3(0.5 - u.z, u.x - 0.5, 0));
    const reference::Surface<double> surface{.normal = n,
                                             .base_color = glm::dvec3(BENCH_BRDF_BASE),
                                             .metallic = BENCH_BRDF_METALLIC,
                                             .roughness = 0.3 + 0.7 * u.z};
    const auto model = [&](reference::BrdfModel m) {
        return reference::evaluate_brdf(m, surface, v, l, table).total().x;
    };
    switch (term) {
        case BENCH_BRDF_MODEL_GLTF:
            return model(reference::BrdfModel::gltf);
        case BENCH_BRDF_MODEL_SEED:
            return model(reference::BrdfModel::seed);
        case BENCH_BRDF_MODEL_BLINN_PHONG:
            return model(reference::BrdfModel::blinn_phong);
        case BENCH_BRDF_MODEL_CONSERVING:
            return model(reference::BrdfModel::conserving);
        default:
            return v.x + v.y + v.z + l.x + l.y + l.z + surface.roughness;
    }
}

/// The sum of one invocation, the inputs as the shader makes them.
[[nodiscard]] inline double loop_sum(std::uint32_t term, std::uint32_t invocation, std::uint32_t count,
                                     const DfgTable& table) {
    std::uint32_t x = invocation * 2654435769u, y = invocation * 1597334677u, z = invocation * 3812015801u;
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        x += 3242174889u, y += 2447445413u, z += 860559425u;
        sum += loop_term(term, glm::dvec3(x >> 9u, y >> 9u, z >> 9u) * 0x1p-23, table);
    }
    return sum;
}

}  // namespace pellucid::bench
