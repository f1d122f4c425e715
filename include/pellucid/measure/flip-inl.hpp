// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of flip.hpp.
#include <pellucid/measure/flip.hpp>
#include <pellucid/measure/detail/flip_pictures.hpp>
#include <pellucid/measure/detail/separable.hpp>
#include <pellucid/measure/fixed_tone_map.hpp>
#include <pellucid/measure/flip_color.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pellucid::inline v0_1::measure {
namespace flip::detail {

using measure::detail::filter_columns;
using measure::detail::filter_rows;
using measure::detail::Plane;

/// One picture as the eye has it.
struct Seen {
    Image<double> color;  ///< [h, w, 3] filtered CIELAB with the Hunt effect
    Plane edge, point;    ///< lengths of the features' gradients, in [0, √2]
};

[[nodiscard]] inline Plane filtered(const Plane& in, const Kernel& rows, const Kernel& columns) {
    return filter_columns(filter_rows(in, rows), columns);
}

/// √(x² + y²) of two planes, in the first.
[[nodiscard]] inline Plane lengths(Plane x, const Plane& y) {
    for (std::size_t i = 0; i < x.data.size(); ++i)
        x.data[i] = std::sqrt(x.data[i] * x.data[i] + y.data[i] * y.data[i]);
    return x;
}

[[nodiscard]] inline Seen seen(const Image<double>& rgb, const ContrastFilters& contrast,
                               const FeatureFilters& features) {
    Plane y(rgb.width, rgb.height, 1), cx = y, cz = y;
    for (std::size_t i = 0; i < y.data.size(); ++i) {
        const Vec3 color = ycxcz_from_rgb({rgb.data[3 * i], rgb.data[3 * i + 1], rgb.data[3 * i + 2]});
        y.data[i] = color[0];
        cx.data[i] = color[1];
        cz.data[i] = color[2];
    }
    Seen result;
    {
        Plane luminance(rgb.width, rgb.height, 1);
        for (std::size_t i = 0; i < y.data.size(); ++i) luminance.data[i] = (y.data[i] + 16) / 116;
        const Plane blurred = filter_rows(luminance, features.gaussian);
        result.edge =
            lengths(filtered(luminance, features.first, features.gaussian), filter_columns(blurred, features.first));
        result.point =
            lengths(filtered(luminance, features.second, features.gaussian), filter_columns(blurred, features.second));
    }
    y = filtered(y, contrast.y, contrast.y);
    cx = filtered(cx, contrast.cx, contrast.cx);
    const Plane second = filtered(cz, contrast.cz[1], contrast.cz[1]);
    cz = filtered(cz, contrast.cz[0], contrast.cz[0]);
    result.color = Image<double>(rgb.width, rgb.height, 3);
    for (std::size_t i = 0; i < y.data.size(); ++i) {
        Vec3 color = rgb_from_ycxcz({y.data[i], cx.data[i], cz.data[i] + second.data[i]});
        for (double& channel : color) channel = std::clamp(channel, 0.0, 1.0);
        color = hunt_adjusted(lab_from_rgb(color));
        std::copy(color.begin(), color.end(), result.color.data.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return result;
}

}  // namespace flip::detail

PELLUCID_INLINE Image<double> flip::error_map(const Image<double>& test, const Image<double>& reference, double ppd) {
    assert(test.width == reference.width && test.height == reference.height);
    assert(test.channels == 3 && reference.channels == 3);
    const ContrastFilters contrast = contrast_filters(ppd);
    const FeatureFilters features = feature_filters(ppd);
    const detail::Seen a = detail::seen(test, contrast, features), b = detail::seen(reference, contrast, features);
    Image<double> errors(test.width, test.height, 1);
    for (std::size_t i = 0; i < errors.data.size(); ++i) {
        const double* p = &a.color.data[3 * i];
        const double* q = &b.color.data[3 * i];
        const double color = color_error(hyab({p[0], p[1], p[2]}, {q[0], q[1], q[2]}));
        const double feature =
            std::max(std::abs(a.edge.data[i] - b.edge.data[i]), std::abs(a.point.data[i] - b.point.data[i])) /
            std::numbers::sqrt2;
        errors.data[i] = std::pow(color, 1 - std::sqrt(std::min(feature, 1.0)));
    }
    return errors;
}

PELLUCID_INLINE Result<FlipError> ldr_flip(const ImageF& test, const ImageF& reference, const FlipOptions& options) {
    PELLUCID_CHECK(detail::check_flip(test, reference, options, "LDR-FLIP"));
    const detail::FlipPictures pictures = detail::flip_pictures(test, reference, 1);
    return detail::pooled(flip::error_map(pictures.test, pictures.reference, options.pixels_per_degree),
                          pictures.finite, options.mask);
}

PELLUCID_INLINE std::string to_json(const FlipError& error) {
    detail::JsonObject object;
    object.add("pixels", error.pixels).add("masked_out", error.masked_out).add("nonfinite", error.nonfinite);
    object.add("mean", error.mean).add("min", error.min).add("max", error.max);
    object.add("weighted_lower_quartile", error.weighted_lower_quartile);
    object.add("weighted_median", error.weighted_median);
    object.add("weighted_upper_quartile", error.weighted_upper_quartile);
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
