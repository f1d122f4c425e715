// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Rules of numerical integration, in double.
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// Points in (0,1) and their weights, which add up to 1.
struct QuadratureRule {
    std::vector<double> at;
    std::vector<double> weight;
    [[nodiscard]] std::size_t size() const noexcept { return at.size(); }
};

/// The n-point Gauss–Legendre rule on [0,1], exact for polynomials of degree 2n − 1: the roots of P_n by Newton's
/// method (Abramowitz and Stegun 25.4.29).  Precondition: n >= 1.
[[nodiscard]] inline QuadratureRule gauss_legendre(std::size_t n) {
    assert(n >= 1);
    QuadratureRule rule{std::vector<double>(n), std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(n) + 0.5));
        double slope = 1;
        for (int step = 0; step < 100; ++step) {
            double previous = 1, value = x;  // P_0 and P_1
            for (std::size_t k = 2; k <= n; ++k) {
                const double order = static_cast<double>(k);
                const double next = ((2 * order - 1) * x * value - (order - 1) * previous) / order;
                previous = value;
                value = next;
            }
            slope = static_cast<double>(n) * (x * value - previous) / (x * x - 1);
            const double change = value / slope;
            x -= change;
            if (std::abs(change) < 1e-15) break;
        }
        rule.at[i] = 0.5 * (1 - x);
        rule.weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

/// The integral of f(x) over [low, high] by the tanh-sinh rule (Takahasi and Mori 1974): x runs through
/// tanh(π/2 sinh t) at equal steps of t, so that algebraic singularities of f or its derivatives at the two ends cost
/// nothing.  `f` is called between the ends, never at them, unless they are closer than rounding.  `step` in t: 0.25
/// gives about 6 digits, 0.125 about 12 for what is smooth inside.  Singularities inside belong at an end: split there.
template <class F>
[[nodiscard]] auto integrate(const F& f, double low, double high, double step = 0.125) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    auto sum = f(middle) * (0.5 * std::numbers::pi);
    for (int k = 1; k * step < 3.2; ++k) {
        const double t = k * step, inner = 0.5 * std::numbers::pi * std::sinh(t), cosine = std::cosh(inner);
        const double weight = 0.5 * std::numbers::pi * std::cosh(t) / (cosine * cosine);
        // 1 − tanh(u) = exp(−u)/cosh(u): the distance from the end keeps its digits.
        const double gap = half * std::exp(-inner) / cosine;
        sum += (f(low + gap) + f(high - gap)) * weight;
    }
    return sum * (step * half);
}

}  // namespace pellucid::inline v0_1::reference
