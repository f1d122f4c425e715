// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What LDR- and HDR-FLIP share around the metric's core: checks, pictures without bad pixels, pooling.
#include <pellucid/measure/fixed_tone_map.hpp>
#include <pellucid/measure/flip.hpp>
#include <algorithm>
#include <limits>
#include <vector>

namespace pellucid::inline v0_1::measure::detail {

[[nodiscard]] inline Result<void> check_flip(const ImageF& test, const ImageF& reference, const FlipOptions& options,
                                             const char* what) {
    PELLUCID_CHECK(check_colors(test, reference, options.mask, what));
    const double ppd = options.pixels_per_degree;
    if (!(ppd >= flip::min_pixels_per_degree && ppd <= flip::max_pixels_per_degree))
        return Error{Errc::invalid_argument, std::string(what) + ": pixels_per_degree is " + std::to_string(ppd) +
                                                 ", but must be in [1, 1000]; a desk monitor has about 67"};
    return {};
}

/// Two pictures [h, w, 3] of linear RGB in [0, limit], black wherever either of them is not finite.
struct FlipPictures {
    Image<double> test, reference;
    std::vector<bool> finite;  ///< h · w, row by row
};

[[nodiscard]] inline FlipPictures flip_pictures(const ImageF& test, const ImageF& reference, double limit) {
    const std::size_t pixels = std::size_t{test.width} * test.height;
    FlipPictures result{Image<double>(test.width, test.height, 3), Image<double>(test.width, test.height, 3),
                        std::vector<bool>(pixels)};
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* a = &test.data[i * test.channels];
        const float* b = &reference.data[i * test.channels];
        if (!finite_color(a, test.channels) || !finite_color(b, test.channels)) continue;
        result.finite[i] = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t from = test.channels == 1 ? 0 : c;
            result.test.data[3 * i + c] = std::clamp<double>(a[from], 0, limit);
            result.reference.data[3 * i + c] = std::clamp<double>(b[from], 0, limit);
        }
    }
    return result;
}

/// The smallest of sorted errors such that the errors up to it add up to more than the fraction `q` of `total`.
[[nodiscard]] inline double weighted_quantile(const std::vector<double>& sorted, double total, double q) {
    double sum = 0;
    for (const double error : sorted)
        if ((sum += error) > q * total) return error;
    return sorted.back();  // all are 0
}

/// Pools the core's errors, after those of pixels that are not finite have become 1.
[[nodiscard]] inline FlipError pooled(const Image<double>& errors, const std::vector<bool>& finite,
                                      const Image8* mask) {
    FlipError result{.map = ImageF(errors.width, errors.height, 1)};
    std::vector<double> sorted;
    sorted.reserve(errors.data.size());
    double sum = 0;
    for (std::size_t i = 0; i < errors.data.size(); ++i) {
        const double error = finite[i] ? errors.data[i] : 1.0;
        result.map.data[i] = static_cast<float>(error);
        if (mask && mask->data[i] != 255) {
            ++result.masked_out;
            continue;
        }
        ++result.pixels;
        result.nonfinite += !finite[i];
        sum += error;
        sorted.push_back(error);
    }
    if (sorted.empty()) {
        result.mean = result.min = result.max = std::numeric_limits<double>::quiet_NaN();
        result.weighted_lower_quartile = result.weighted_median = result.weighted_upper_quartile = result.mean;
        return result;
    }
    std::sort(sorted.begin(), sorted.end());
    result.mean = sum / static_cast<double>(sorted.size());
    result.min = sorted.front();
    result.max = sorted.back();
    result.weighted_lower_quartile = weighted_quantile(sorted, sum, 0.25);
    result.weighted_median = weighted_quantile(sorted, sum, 0.5);
    result.weighted_upper_quartile = weighted_quantile(sorted, sum, 0.75);
    return result;
}

}  // namespace pellucid::inline v0_1::measure::detail
