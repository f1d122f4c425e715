// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of hdr_flip.hpp.
#include <pellucid/measure/hdr_flip.hpp>
#include <pellucid/measure/detail/flip_pictures.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pellucid::inline v0_1::measure {
namespace flip::detail {

/// y = (k0 x² + k1 x) / (k3 x² + k4 x + k5): the fit has 2.51, 0.03, 2.43, 0.59, 0.14 for 0.6 x.
inline constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03, k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;
inline constexpr double most_light = 65536, least_luminance = 0x1p-23;

}  // namespace flip::detail

PELLUCID_INLINE double flip::aces(double x) noexcept {
    using namespace detail;
    return std::clamp((k0 * x + k1) * x / ((k3 * x + k4) * x + k5), 0.0, 1.0);
}

PELLUCID_INLINE double flip::brightest_shown() noexcept {
    using namespace detail;
    constexpr double t = 0.85, a = k0 - t * k3, b = k1 - t * k4, c = -t * k5;  // a x² + b x + c = 0
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

PELLUCID_INLINE flip::ExposureRange flip::exposure_range(const Image<double>& reference) {
    std::vector<double> luminances;
    luminances.reserve(reference.data.size() / 3);
    for (std::size_t i = 0; i + 2 < reference.data.size(); i += 3)
        luminances.push_back(0.2126 * reference.data[i] + 0.7152 * reference.data[i + 1] +
                             0.0722 * reference.data[i + 2]);
    // The upper median, as in the authors' implementation.
    const auto median = [](std::vector<double>& values) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    const auto brightest = std::max_element(luminances.begin(), luminances.end());
    if (brightest == luminances.end() || !(*brightest > 0)) return {};
    const double most = *brightest;
    double middle = median(luminances);
    if (!(middle > 0)) {
        std::erase_if(luminances, [](double y) { return !(y > 0); });
        middle = median(luminances);
    }
    return {std::log2(brightest_shown() / std::max(most, detail::least_luminance)),
            std::log2(brightest_shown() / std::max(middle, detail::least_luminance))};
}

PELLUCID_INLINE std::uint32_t flip::exposure_count(const ExposureRange& range) noexcept {
    return static_cast<std::uint32_t>(std::max(2.0, std::ceil(range.stop - range.start)));
}

PELLUCID_INLINE Result<HdrFlipError> hdr_flip(const ImageF& test, const ImageF& reference,
                                              const HdrFlipOptions& options) {
    PELLUCID_CHECK(detail::check_flip(test, reference, {options.pixels_per_degree, options.mask}, "HDR-FLIP"));
    const detail::FlipPictures pictures = detail::flip_pictures(test, reference, flip::detail::most_light);
    flip::ExposureRange range = flip::exposure_range(pictures.reference);
    if (!std::isnan(options.start_exposure)) range.start = options.start_exposure;
    if (!std::isnan(options.stop_exposure)) range.stop = options.stop_exposure;
    if (!(range.start >= -100 && range.start <= range.stop && range.stop <= 100))
        return Error{Errc::invalid_argument, "HDR-FLIP: exposures go from " + std::to_string(range.start) + " to " +
                                                 std::to_string(range.stop) +
                                                 " stops, but must rise and be in [-100, 100]"};
    if (options.exposures == 1 || options.exposures > 256)
        return Error{Errc::invalid_argument, "HDR-FLIP: exposures is " + std::to_string(options.exposures) +
                                                 ", but must be 2 ... 256, or 0 to follow the range"};
    const std::uint32_t count = options.exposures ? options.exposures : flip::exposure_count(range);

    const std::size_t pixels = std::size_t{test.width} * test.height;
    Image<double> largest(test.width, test.height, 1);
    HdrFlipError result{{}, ImageF(test.width, test.height, 1), range.start, range.stop, count};
    std::fill(result.exposure.data.begin(), result.exposure.data.end(), static_cast<float>(range.start));
    Image<double> a = pictures.test, b = pictures.reference;
    for (std::uint32_t n = 0; n < count; ++n) {
        const double exposure = range.start + (range.stop - range.start) * n / (count - 1), scale = std::exp2(exposure);
        for (std::size_t i = 0; i < a.data.size(); ++i) {
            a.data[i] = flip::aces(pictures.test.data[i] * scale);
            b.data[i] = flip::aces(pictures.reference.data[i] * scale);
        }
        const Image<double> errors = flip::error_map(a, b, options.pixels_per_degree);
        for (std::size_t i = 0; i < pixels; ++i)
            if (errors.data[i] > largest.data[i]) {
                largest.data[i] = errors.data[i];
                result.exposure.data[i] = static_cast<float>(exposure);
            }
    }
    result.error = detail::pooled(largest, pictures.finite, options.mask);
    return result;
}

PELLUCID_INLINE std::string to_json(const HdrFlipError& error) {
    detail::JsonObject object;
    object.raw("error", to_json(error.error)).add("start_exposure", error.start_exposure);
    object.add("stop_exposure", error.stop_exposure).add("exposures", std::uint64_t{error.exposures});
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
