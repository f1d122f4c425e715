// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of sky.hpp.
///
/// The sky is horizon + (zenith − horizon) s(y) + (nadir − horizon) s(−y) with s(y) = max(y, 0)^0.4, and prefiltering
/// is linear and knows no up: one scalar function of y and roughness, the prefiltered s, makes all three channels.
#include <pellucid/scene/sky.hpp>
#include <array>
#include <numbers>

namespace pellucid::inline v0_1 {
namespace detail {

/// Gauss–Legendre on [0,1] with 12 points: Abramowitz and Stegun, table 25.4, the positive half on [-1,1].
inline constexpr std::size_t sky_points = 12;
struct SkyRule {
    std::array<double, sky_points> at{}, weight{};
    constexpr SkyRule() {
        constexpr double x[] = {0.125233408511468915472, 0.367831498998180193753, 0.587317954286617447297,
                                0.769902674194304687037, 0.904117256370474856678, 0.981560634246719250691};
        constexpr double w[] = {0.249147045813402785001, 0.233492536538354808761, 0.203167426723065921749,
                                0.160078328543346226335, 0.106939325995318430960, 0.047175336386511827195};
        for (std::size_t i = 0; i < sky_points; ++i) {
            const std::size_t k = i < 6 ? i : i - 6;
            at[i] = 0.5 + (i < 6 ? 0.5 : -0.5) * x[k];
            weight[i] = 0.5 * w[k];
        }
    }
};

/// Prefilters s(y) = max(y, 0)^0.4.
class SkyFilter {
public:
    SkyFilter() {
        for (std::size_t i = 0; i < sky_points; ++i) {
            const double tau = 0.5 * std::numbers::pi * rule_.at[i];
            sine2_[i] = std::sin(tau) * std::sin(tau);
            crossing_weight_[i] = rule_.weight[i] * std::pow(std::cos(tau), 1.8);
        }
    }

    /// Around a ray of upward component y, α in (0,1].
    [[nodiscard]] double operator()(double y, double alpha) const {
        // tan θ_h = α tan ψ makes D(H)(N·H) uniform in sin²ψ (Walter et al. 2007); N·L > 0 ends at θ_h = 45°, and the
        // ring of directions at 2 θ_h from the ray touches the horizon at sin 2θ_h = |y|: there the rule is split.
        const double end = std::atan(1 / alpha);
        const double touch = std::min(std::atan(std::tan(0.5 * std::asin(std::abs(y))) / alpha), end);
        const double level = std::sqrt((1 - y) * (1 + y));
        double sum = 0, total = 0;
        for (const bool beyond : {false, true})
            for (std::size_t i = 0; i < sky_points; ++i) {
                // Points crowd where s of the ring has no derivatives.
                const double t = rule_.at[i];
                const double psi = beyond ? touch + (end - touch) * t * t : touch * t * (2 - t);
                const double step = rule_.weight[i] * 2 * (beyond ? (end - touch) * t : touch * (1 - t));
                const double tangent = alpha * std::tan(psi), square = 1 + tangent * tangent;
                const double mu = (1 - tangent) * (1 + tangent) / square, weight = step * std::sin(2 * psi) * mu;
                sum += weight * ring_mean(y * mu, level * 2 * tangent / square);
                total += weight;
            }
        return sum / total;
    }

private:
    /// The mean of max(a + b cos φ, 0)^0.4, b >= 0.  Below the horizon at some φ: with k² = (a+b)/2b and
    /// sin(φ/2) = k sin τ, it is (a+b)^0.4 (2k/π) ∫ cos^1.8 τ / √(1 − k² sin²τ) dτ over a quarter turn.
    [[nodiscard]] double ring_mean(double a, double b) const {
        if (a <= -b) return 0;
        double sum = 0;
        if (a >= b) {
            for (std::size_t i = 0; i < sky_points; ++i)
                sum += rule_.weight[i] * std::pow(std::max(a + b - 2 * b * sine2_[i], 0.0), 0.4);
            return sum;
        }
        const double k2 = (a + b) / (2 * b);
        for (std::size_t i = 0; i < sky_points; ++i) sum += crossing_weight_[i] / std::sqrt(1 - k2 * sine2_[i]);
        return std::pow(a + b, 0.4) * std::sqrt(k2) * sum;
    }

    static constexpr SkyRule rule_{};
    std::array<double, sky_points> sine2_{}, crossing_weight_{};
};

}  // namespace detail

PELLUCID_INLINE glm::dvec3 prefiltered_sky(const Sky& sky, double y, double roughness) {
    if (roughness == 0) return sky_radiance(sky, y);
    static const detail::SkyFilter filter;
    // A lobe narrower than this is a mirror's to 0.01 %.
    const double alpha = std::max(roughness * roughness, 1e-6), at = std::clamp(y, -1.0, 1.0);
    const glm::dvec3 horizon(sky.horizon), zenith(sky.zenith), nadir(sky.nadir);
    return horizon + (zenith - horizon) * filter(at, alpha) + (nadir - horizon) * filter(-at, alpha);
}

PELLUCID_INLINE ImageF make_sky_table(const Sky& sky) {
    constexpr std::uint32_t half = sky_columns / 2;
    const detail::SkyFilter filter;
    ImageF table(sky_columns, sky_rows, 3);
    for (std::uint32_t row = 0; row < sky_rows; ++row) {
        const double roughness = std::pow(row / (sky_rows - 1.0), 1 / 0.55), alpha = roughness * roughness;
        for (std::uint32_t i = 0; i < half; ++i) {
            const double y = std::pow(i / (half - 1.0), 1 / (0.3 + 0.4 * roughness));
            const double over = row == 0 ? std::pow(y, 0.4) : filter(y, alpha);  // s at y
            const double under = row == 0 ? 0.0 : filter(-y, alpha);             // s at −y
            float* above_texel = table.texel(half + i, row);
            float* below_texel = table.texel(half - 1 - i, row);
            for (int c = 0; c < 3; ++c) {
                const double horizon = sky.horizon[c], up = sky.zenith[c] - horizon, down = sky.nadir[c] - horizon;
                above_texel[c] = static_cast<float>(horizon + up * over + down * under);
                below_texel[c] = static_cast<float>(horizon + up * under + down * over);
            }
        }
    }
    return table;
}

}  // namespace pellucid::inline v0_1
