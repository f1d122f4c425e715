// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The clock of the benchmarks and the statistics that they report: medians and quartiles, never means.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace pellucid::bench {

/// [ns] of a steady clock; only differences mean anything.
[[nodiscard]] inline double now_ns() noexcept {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Order statistics of one sample, in the sample's own unit.
struct Summary {
    double median = 0;
    double q1 = 0, q3 = 0;           ///< first and third quartile: half of the values lie between them
    double lowest = 0, highest = 0;  ///< the whole spread
    std::size_t count = 0;           ///< 0: nothing was measured, and the values mean nothing
};

/// The quantile `q` in [0, 1] of a sorted, non-empty sample, linear between neighbours: the value at position
/// q (n - 1) (Hyndman and Fan 1996, definition 7).
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double q) {
    const double position = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

[[nodiscard]] inline Summary summarise(std::vector<double> sample) {
    if (sample.empty()) return {};
    std::sort(sample.begin(), sample.end());
    return {.median = quantile(sample, 0.5),
            .q1 = quantile(sample, 0.25),
            .q3 = quantile(sample, 0.75),
            .lowest = sample.front(),
            .highest = sample.back(),
            .count = sample.size()};
}

/// The ratios a[i] / b[i] of two samples taken in the same rounds: what the machine did to a round cancels.
/// Precondition: equal sizes, no zero in `b`.
[[nodiscard]] inline std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> out(a.size());
    std::transform(a.begin(), a.end(), b.begin(), out.begin(), [](double x, double y) { return x / y; });
    return out;
}

/// The differences a[i] - b[i] of two samples taken in the same rounds.  Precondition: equal sizes.
[[nodiscard]] inline std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> out(a.size());
    std::transform(a.begin(), a.end(), b.begin(), out.begin(), [](double x, double y) { return x - y; });
    return out;
}

}  // namespace pellucid::bench
