// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The directional albedo of the specular lobe D V F of glTF: what share of a white environment it reflects towards the
/// eye, E(μ, α; F0) = scale F0 + bias, with μ = N·V and α = roughness².  In the words of the split sum (Karis 2013):
/// scale = ∫ (1 − x⁵) D V (N·L) dL, bias = ∫ x⁵ D V (N·L) dL, x = 1 − V·H.
///
/// The integral is taken over the normals that the eye sees (Heitz 2014), where E = mean of F G₂/G₁: bounded by 1, and
/// with α scaled away.  Those normals are points of a spherical cap (Dupuy and Benyoub 2023): with w = the stretched
/// view (α sin θ, 0, μ)/|…|, a point c of the unit sphere with c.z > −w.z gives H = (α (c + w).xy, (c + w).z)
/// normalised, and all c are equally likely.  In height above the cap's rim, h = c.z + w.z in (0, 1 + w.z], and azimuth
/// φ, N·L is (a + b cos φ)/|…|², so the φ at which L sets is known (`acos(−a/b)`), and so are the two heights between
/// which L sets at some φ: below the lower one no L is above the horizon, above the upper one all are.  Between such
/// limits the integrand is smooth, and Gauss' rule converges: two panels of height, h = lower +
/// width t² in the first and lower + width t³ in the second, times φ.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// Gauss' rule on [0,1].
struct GaussRule {
    std::vector<double> nodes;    ///< in (0,1), rising
    std::vector<double> weights;  ///< their sum is 1
};

/// The rule of `count` >= 1 points, from the zeros of the Legendre polynomial by Newton's method.
[[nodiscard]] inline GaussRule gauss_rule(int count);

/// A directional albedo, or its cosine-weighted average 2∫E μ dμ, for all F0.  Stored as what is lost, because that is
/// what multiple scattering gives back, and it may be small.
template <std::floating_point T = double>
struct Dfg {
    T loss = T(0);  ///< 1 − scale − bias: what a white lobe (F0 = 1) does not reflect, [0,1]
    T bias = T(0);  ///< what a lobe of F0 = 0 reflects, [0, 1 − loss]
    [[nodiscard]] T scale() const noexcept { return T(1) - loss - bias; }
    /// E(F0) = scale F0 + bias, as a blend of its two ends.
    [[nodiscard]] T albedo(T f0) const noexcept { return f0 * (T(1) - loss) + (T(1) - f0) * bias; }
};

/// (1 − μ)⁵: Schlick's weight of a mirror.
template <std::floating_point T>
[[nodiscard]] T mirror_weight(T mu) noexcept {
    const T x = T(1) - mu, x2 = x * x;
    return x2 * x2 * x;
}

/// The integral with 2 n² evaluations of the lobe, n the number of points of the rule.  μ in [0,1], α in [1e-8,1] (0:
/// the mirror; the grazing mirror reflects all).  Largest error of scale, bias and their sum over all μ and roughness
/// from 0.004 on: n = 7: 3.0e-4; 8: 1.7e-4; 12: 3.1e-5; 16: 1e-5; 24: 2e-6; 32: 6e-7; 48: 1.3e-7.  Float adds 2e-6. A
/// shader follows it line by line; it needs no random numbers.
template <std::floating_point T>
[[nodiscard]] Dfg<T> integrate_dfg(T mu, T alpha, const GaussRule& rule) noexcept;

/// Converged to 1e-6, by the rule of 48 points.
[[nodiscard]] inline Dfg<double> exact_dfg(double mu, double alpha);

/// What a shader computes for a texel with at most `samples` >= 2 evaluations; 128 give 1.7e-4 (the rule of 8 points,
/// whose nodes and weights are eight constants: it is symmetric).
template <std::floating_point T>
[[nodiscard]] Dfg<T> sampled_dfg(T mu, T alpha, int samples = 128);

/// 2∫E(μ) μ dμ, converged to 1e-6: Gauss' rule in t with μ = t², which grades towards grazing views.
[[nodiscard]] inline Dfg<double> exact_dfg_average(double alpha);

// ---------------------------------------------------------------------------------------------------- bodies

GaussRule gauss_rule(int count) {
    GaussRule out{std::vector<double>(static_cast<std::size_t>(count)),
                  std::vector<double>(static_cast<std::size_t>(count))};
    for (std::size_t i = 0; i < out.nodes.size(); ++i) {
        double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (count + 0.5)), slope = 0;
        for (int step = 0; step < 50; ++step) {
            double before = 1, now = x;
            for (int k = 2; k <= count; ++k) {
                const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
                before = now;
                now = next;
            }
            slope = count * (x * now - before) / (x * x - 1);
            const double change = now / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        out.nodes[i] = 0.5 * (1 - x);
        out.weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
    return out;
}

template <std::floating_point T>
Dfg<T> integrate_dfg(T mu, T alpha, const GaussRule& rule) noexcept {
    const T pi = std::numbers::pi_v<T>;
    const T a2 = alpha * alpha;
    const T sine = std::sqrt(std::max((T(1) - mu) * (T(1) + mu), T(0)));
    const T stretched = std::sqrt(a2 * sine * sine + mu * mu);
    if (!(stretched > T(0))) return {T(0), T(1)};
    const T wx = alpha * sine / stretched, wz = mu / stretched;
    const T root_v = std::sqrt((mu - a2 * mu) * mu + a2);  // μ (1 + 2 Λ(V))
    // H in the plane of N and V, its tangent (1 + sin θ)/μ on the eye's side and −μ/(1 + sin θ) on the other: L sets.
    const T k = T(1) + sine;
    const T numerator = T(2) * a2 * mu * k;
    const T top = T(1) + wz;
    const T none_below = numerator / (stretched * (k * k + a2 * mu * mu));
    const T all_above = std::min(numerator / (stretched * (mu * mu + a2 * k * k)), top);

    T scale = T(0), bias = T(0);
    for (int panel = 0; panel < 2; ++panel) {
        const T lower = panel == 0 ? none_below : all_above;
        const T width = (panel == 0 ? all_above : top) - lower;
        if (!(width > T(0))) continue;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const T t = static_cast<T>(rule.nodes[i]);
            const T h = lower + width * (panel == 0 ? t * t : t * t * t), z = h - wz;
            const T slope = panel == 0 ? T(2) * t : T(3) * t * t;
            const T weight_h = static_cast<T>(rule.weights[i]) * slope * width / top;
            const T s = std::sqrt(std::max((T(1) - z) * (T(1) + z), T(0)));
            // |H|² = base + swing cos φ;  N·L |H|² = a + b cos φ
            const T base = a2 * (s * s + wx * wx) + h * h, swing = T(2) * a2 * s * wx;
            const T a = T(2) * (sine * alpha * wx + mu * h) * h - mu * base;
            const T b = T(2) * sine * alpha * s * h - mu * swing;
            T first = T(0), last = pi;
            if (panel == 0) (b > T(0) ? last : first) = std::acos(std::clamp(-a / b, T(-1), T(1)));
            for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
                const T c = std::cos(first + (last - first) * static_cast<T>(rule.nodes[j]));
                const T length2 = base + swing * c;
                const T n_l = std::min((a + b * c) / length2, T(1));
                if (!(n_l > T(0))) continue;
                const T v_h = (sine * alpha * (s * c + wx) + mu * h) / std::sqrt(length2);
                const T root_l = std::sqrt((n_l - a2 * n_l) * n_l + a2);
                const T share = (mu + root_v) * n_l / (n_l * root_v + mu * root_l);  // G₂/G₁
                const T fresnel = mirror_weight(std::clamp(v_h, T(0), T(1)));
                const T weight = weight_h * static_cast<T>(rule.weights[j]) * (last - first) / pi * share;
                scale += weight * (T(1) - fresnel);
                bias += weight * fresnel;
            }
        }
    }
    const T loss = std::max(T(1) - (scale + bias), T(0));
    return {loss, std::min(bias, T(1) - loss)};
}

Dfg<double> exact_dfg(double mu, double alpha) {
    static const GaussRule rule = gauss_rule(48);
    return integrate_dfg(mu, alpha, rule);
}

template <std::floating_point T>
Dfg<T> sampled_dfg(T mu, T alpha, int samples) {
    return integrate_dfg(mu, alpha, gauss_rule(std::max(static_cast<int>(std::sqrt(samples / 2)), 1)));
}

Dfg<double> exact_dfg_average(double alpha) {
    static const GaussRule rule = gauss_rule(48);
    Dfg<double> out;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = rule.nodes[i], mu = t * t;
        const double weight = rule.weights[i] * 2 * t * 2 * mu;
        const Dfg<double> at = exact_dfg(mu, alpha);
        out.loss += weight * at.loss;
        out.bias += weight * at.bias;
    }
    return out;
}

}  // namespace pellucid::inline v0_1::reference
