// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What FLIP knows of the eye's resolution: pixels per degree, the contrast-sensitivity filters, and the detectors of
/// edges and points.  After Andersson et al. 2020 (see flip_color.hpp).
///
/// All filters are products of filters of one dimension.  The paper's filters are normalised in two dimensions; since
/// each is one Gaussian, one derivative, or a sum of two Gaussians, normalising the factors gives the same weights.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pellucid::inline v0_1::measure::flip {

/// Pixels per degree of visual angle: distance · (pixels across / width) · π/180.
/// \param distance from the eye to the monitor [m]  \param width of the monitor [m]
[[nodiscard]] constexpr double pixels_per_degree(double distance, double pixels_across, double width) noexcept {
    return distance * (pixels_across / width) * (std::numbers::pi / 180);
}

/// 67.02: a monitor 3840 pixels and 0.7 m wide, seen from 0.7 m.
inline constexpr double default_pixels_per_degree = pixels_per_degree(0.7, 3840, 0.7);
/// What the metric takes.  Below 1 a detector's Gaussian has no weight outside its centre; above 1000 filters are wider
/// than pictures.
inline constexpr double min_pixels_per_degree = 1, max_pixels_per_degree = 1000;

/// Weights at −radius … radius.
using Kernel = std::vector<double>;

/// The contrast-sensitivity filters of the three channels of YyCxCz.  The eye's sensitivity, as a function of spatial
/// frequency, is fitted by Gaussians; in the picture that is a √(π/b) exp(−π² x²/b), x in degrees, with (a, b) =
/// (1, 0.0047) for Yy, (1, 0.0053) for Cx, and for Cz the sum of (34.1, 0.04) and (13.5, 0.025).
/// All have the radius of the widest, ⌈3 √(0.04 / 2π²) ppd⌉.  `y` and `cx` sum to 1; `cz[0]` and `cz[1]` are the
/// factors of the two terms, and the squares of their sums add up to 1.
struct ContrastFilters {
    Kernel y, cx, cz[2];
};

/// Detectors on luminance, σ = ½ · 0.082° · ppd pixels, radius ⌈3σ⌉: a Gaussian g (sum 1), its first derivative −x g
/// and its second (x²/σ² − 1) g, of which positive and negative weights are scaled to sum to 1 and −1 each. An edge
/// along an axis is `first` along it times `gaussian` across it; a point likewise with `second`.
struct FeatureFilters {
    Kernel gaussian, first, second;
};

/// Precondition of both: min_pixels_per_degree <= ppd <= max_pixels_per_degree.
[[nodiscard]] inline ContrastFilters contrast_filters(double ppd);
[[nodiscard]] inline FeatureFilters feature_filters(double ppd);

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// f at −radius … radius.
template <class F>
[[nodiscard]] Kernel sampled(int radius, const F& f) {
    Kernel weights;
    weights.reserve(2 * static_cast<std::size_t>(radius) + 1);
    for (int x = -radius; x <= radius; ++x) weights.push_back(f(static_cast<double>(x)));
    return weights;
}
[[nodiscard]] inline double sum(const Kernel& weights) {
    double total = 0;
    for (const double w : weights) total += w;
    return total;
}
inline void divide(Kernel& weights, double by) {
    for (double& w : weights) w /= by;
}
/// Positive weights to the sum 1, negative ones to the sum −1.
inline void balance(Kernel& weights) {
    double positive = 0, negative = 0;
    for (const double w : weights) (w > 0 ? positive : negative) += w;
    for (double& w : weights) w /= w > 0 ? positive : -negative;
}

}  // namespace detail

ContrastFilters contrast_filters(double ppd) {
    constexpr double pi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const auto gaussian = [&](double scale, double b) {
        return detail::sampled(radius, [&](double x) { return scale * std::exp(-pi * pi * x * x / (ppd * ppd * b)); });
    };
    ContrastFilters filters{gaussian(1, 0.0047), gaussian(1, 0.0053), {}};
    detail::divide(filters.y, detail::sum(filters.y));
    detail::divide(filters.cx, detail::sum(filters.cx));
    constexpr double terms[2][2] = {{34.1, 0.04}, {13.5, 0.025}};
    double total = 0;  // of the two-dimensional weights
    for (int i = 0; i < 2; ++i) {
        // The square root of a term's factor: the factor comes back where rows and columns are multiplied.
        filters.cz[i] = gaussian(std::sqrt(terms[i][0] * std::sqrt(pi / terms[i][1])), terms[i][1]);
        total += detail::sum(filters.cz[i]) * detail::sum(filters.cz[i]);
    }
    for (Kernel& kernel : filters.cz) detail::divide(kernel, std::sqrt(total));
    return filters;
}

/// The filters of edges and of points for `ppd` pixels per degree.
FeatureFilters feature_filters(double ppd) {
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * sigma * sigma)); };
    FeatureFilters filters{
        detail::sampled(radius, gaussian), detail::sampled(radius, [&](double x) { return -x * gaussian(x); }),
        detail::sampled(radius, [&](double x) { return (x * x / (sigma * sigma) - 1) * gaussian(x); })};
    detail::divide(filters.gaussian, detail::sum(filters.gaussian));
    detail::balance(filters.first);
    detail::balance(filters.second);
    return filters;
}

}  // namespace pellucid::inline v0_1::measure::flip
