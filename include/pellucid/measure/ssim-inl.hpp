// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of ssim.hpp.
#include <pellucid/measure/ssim.hpp>
#include <pellucid/measure/detail/separable.hpp>
#include <pellucid/measure/fixed_tone_map.hpp>
#include <array>
#include <cmath>
#include <limits>

namespace pellucid::inline v0_1::measure {
namespace detail {

inline constexpr std::uint32_t ssim_radius = ssim_window / 2;

/// exp(−x² / (2 · 1.5²)) at −5 … 5, with the sum 1.
[[nodiscard]] inline std::array<double, ssim_window> ssim_kernel() {
    std::array<double, ssim_window> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < ssim_window; ++i) {
        const double x = static_cast<double>(i) - ssim_radius;
        sum += weights[i] = std::exp(-x * x / 4.5);
    }
    for (double& w : weights) w /= sum;
    return weights;
}

}  // namespace detail

PELLUCID_INLINE Result<SsimResult> ssim(const ImageF& test, const ImageF& reference, const Image8* mask) {
    PELLUCID_CHECK(detail::check_colors(test, reference, mask, "SSIM"));
    if (test.width < ssim_window || test.height < ssim_window)
        return Error{Errc::invalid_argument, "SSIM: the pictures are " + detail::shape(test) +
                                                 ", but must be at least 11 pixels wide and high to hold one window"};
    using detail::Plane;
    Plane x(test.width, test.height, 1), y = x, xx = x, yy = x, xy = x, bad = x;
    bool any_bad = false;
    for (std::size_t i = 0; i < x.data.size(); ++i) {
        const float* a = &test.data[i * test.channels];
        const float* b = &reference.data[i * test.channels];
        if (!finite_color(a, test.channels) || !finite_color(b, test.channels)) {
            bad.data[i] = 1;
            any_bad = true;
            continue;
        }
        const double p = x.data[i] = fixed_luma(a, test.channels), q = y.data[i] = fixed_luma(b, test.channels);
        xx.data[i] = p * p;
        yy.data[i] = q * q;
        xy.data[i] = p * q;
    }
    const std::array<double, ssim_window> kernel = detail::ssim_kernel();
    for (Plane* plane : {&x, &y, &xx, &yy, &xy})
        *plane = detail::filter_columns(detail::filter_rows(*plane, kernel), kernel);
    if (any_bad) bad = detail::filter_columns(detail::filter_rows(bad, kernel), kernel);  // > 0: in the window

    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    constexpr std::uint32_t r = detail::ssim_radius;
    SsimResult result{.map = ImageF(test.width, test.height, 1)};
    std::fill(result.map.data.begin(), result.map.data.end(), std::numeric_limits<float>::quiet_NaN());
    double sum = 0;
    for (std::uint32_t v = r; v < test.height - r; ++v)
        for (std::uint32_t u = r; u < test.width - r; ++u) {
            const std::size_t i = std::size_t{v} * test.width + u;
            const double mx = x.data[i], my = y.data[i];
            const double vx = xx.data[i] - mx * mx, vy = yy.data[i] - my * my, cov = xy.data[i] - mx * my;
            const double similarity =
                bad.data[i] > 0 ? -1
                                : (2 * mx * my + c1) * (2 * cov + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
            result.map.data[i] = static_cast<float>(similarity);
            if (!detail::compared(mask, u, v)) continue;
            ++result.windows;
            result.nonfinite += bad.data[i] > 0;
            sum += similarity;
        }
    result.mean = sum / static_cast<double>(result.windows);  // 0/0 where no window counts
    return result;
}

PELLUCID_INLINE std::string to_json(const SsimResult& result) {
    detail::JsonObject object;
    object.add("windows", result.windows).add("nonfinite", result.nonfinite).add("mean", result.mean);
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
