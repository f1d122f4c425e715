// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What surfaces make of light that depends on height alone, such as the procedural sky (scene/sky.hpp): integrals of
/// one and two dimensions, in double.  A zonal function is any f(y), y in [-1,1] the upward component of a unit
/// direction, that is smooth but for y = 0.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <pellucid/reference/quadrature.hpp>
#include <pellucid/scene/sky.hpp>

namespace pellucid::inline v0_1::reference {

/// E(n)/π of a zonal function for a normal whose upward component is `y`: ∫ f(h) K(h) dh over heights, with
/// K(h) = (1/π) ∫ max(a + b cos φ, 0) dφ, a = y h, b = √(1−y²)√(1−h²), in closed form.  `step`: see `integrate`.
template <class Zonal>
[[nodiscard]] auto zonal_diffuse(const Zonal& f, double y, double step = 0.125);

/// The GGX-prefiltered radiance (environment.hpp) of a zonal function around a direction whose upward component is `y`:
/// rings around it of equal weight, the mean of f along each; split where a ring touches the horizon, and along a ring
/// where it crosses.  α = 0 is f(y).
template <class Zonal>
[[nodiscard]] auto zonal_prefiltered(const Zonal& f, double y, double alpha, double step = 0.125);

/// The approximation that the document has, kept to be measured: the sky mixed towards (0.3, 0.35, 0.4) by roughness².
/// As "diffuse" light it takes roughness 1, a constant.
[[nodiscard]] inline glm::dvec3 seed_environment(const Sky& sky, double y, double roughness) noexcept {
    const double share = roughness * roughness;
    return sky_radiance(sky, y) * (1 - share) + glm::dvec3(0.3, 0.35, 0.4) * share;
}

// ---------------------------------------------------------------------------------------------------- bodies

template <class Zonal>
auto zonal_diffuse(const Zonal& f, double y, double step) {
    const double level = std::sqrt(std::max((1 - y) * (1 + y), 0.0));
    const auto integrand = [&](double h) {
        const double a = y * h, b = level * std::sqrt(std::max((1 - h) * (1 + h), 0.0));
        double kernel = 0;
        if (a >= b) {
            kernel = 2 * a;
        } else if (a > -b) {
            const double crossing = std::acos(-a / b);
            kernel = 2 / std::numbers::pi * (a * crossing + b * std::sin(crossing));
        }
        return f(h) * kernel;
    };
    // K has kinks where the circle of equal height touches the surface's own horizon, |h| = √(1−y²).
    auto sum = integrate(integrand, 0, level, step) + integrate(integrand, level, 1, step);
    return sum + integrate(integrand, -level, 0, step) + integrate(integrand, -1, -level, step);
}

template <class Zonal>
auto zonal_prefiltered(const Zonal& f, double y, double alpha, double step) {
    const double level = std::sqrt(std::max((1 - y) * (1 + y), 0.0));
    const auto ring_mean = [&](double a, double b) {  // of f(a + b cos φ)
        const auto at = [&](double phi) { return f(std::clamp(a + b * std::cos(phi), -1.0, 1.0)); };
        if (std::abs(a) >= b) return integrate(at, 0, std::numbers::pi, step) / std::numbers::pi;
        const double crossing = std::acos(-a / b);
        return (integrate(at, 0, crossing, step) + integrate(at, crossing, std::numbers::pi, step)) / std::numbers::pi;
    };
    // tan θ_h = α tan ψ makes D(H)(N·H) uniform in sin²ψ (Walter et al. 2007); N·L > 0 ends at θ_h = 45°.
    const auto integrand = [&](double psi) {
        const double tangent = alpha * std::tan(psi), mu = (1 - tangent) * (1 + tangent) / (1 + tangent * tangent);
        const double sine = 2 * tangent / (1 + tangent * tangent);
        return ring_mean(y * mu, level * sine) * (std::sin(2 * psi) * std::max(mu, 0.0));
    };
    const auto weight = [&](double psi) {
        const double tangent = alpha * std::tan(psi);
        return std::sin(2 * psi) * (1 - tangent) * (1 + tangent) / (1 + tangent * tangent);
    };
    if (!(alpha > 0)) return f(y) * 1.0;
    // The ring at θ_l = 2 θ_h touches the horizon at sin θ_l = |y|.
    const double end = std::atan(1 / alpha), touch = std::atan(std::tan(0.5 * std::asin(std::abs(y))) / alpha);
    auto sum = integrate(integrand, 0, touch, step) + integrate(integrand, touch, end, step);
    return sum / (integrate(weight, 0, touch, step) + integrate(weight, touch, end, step));
}

}  // namespace pellucid::inline v0_1::reference
