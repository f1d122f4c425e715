// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Order statistics of measurements: medians with their spread, and percentiles of error.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::measure {

/// Quantile `q` in [0,1] of sorted values, by linear interpolation between order statistics: position (n−1) q
/// (definition 7 of Hyndman and Fan 1996).  0 where there are none.
[[nodiscard]] inline double quantile_of_sorted(std::span<const double> sorted, double q) noexcept {
    if (sorted.empty()) return 0;
    const double position = static_cast<double>(sorted.size() - 1) * std::clamp(q, 0.0, 1.0);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (sorted[above] - sorted[below]) * (position - static_cast<double>(below));
}

/// The smallest of `values` that at least the fraction `q` of them do not exceed: the ⌈q n⌉-th smallest, the least for
/// q = 0 (nearest rank; it is always one of the values).  Reorders `values`.  0 where there are none.
/// Precondition: no NaN; q in [0,1].
[[nodiscard]] inline double nearest_rank(std::span<double> values, double q) noexcept {
    if (values.empty()) return 0;
    const double exact = q * static_cast<double>(values.size());
    // A product such as 0.999 · 1000 may come out just above the whole number it stands for.
    const auto rank = static_cast<std::size_t>(std::max(std::ceil(exact - 1e-9 * exact), 1.0));
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size()) - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Five numbers and the mean.  All 0 where there are no values.
struct Summary {
    std::size_t count = 0;
    double min = 0, lower_quartile = 0, median = 0, upper_quartile = 0, max = 0;
    double mean = 0;
    /// Distance between the quartiles: the spread that is reported beside a median.
    [[nodiscard]] double spread() const noexcept { return upper_quartile - lower_quartile; }
};

/// Precondition: no NaN.
[[nodiscard]] inline Summary summarize(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    double sum = 0;
    for (const double value : values) sum += value;
    return {.count = values.size(),
            .min = values.front(),
            .lower_quartile = quantile_of_sorted(values, 0.25),
            .median = quantile_of_sorted(values, 0.5),
            .upper_quartile = quantile_of_sorted(values, 0.75),
            .max = values.back(),
            .mean = sum / static_cast<double>(values.size())};
}

/// The middle value, or the mean of the middle two; NaN for no values.
[[nodiscard]] inline double median(std::vector<double> values) {
    return summarize(std::move(values)).median;
}

}  // namespace pellucid::inline v0_1::measure
