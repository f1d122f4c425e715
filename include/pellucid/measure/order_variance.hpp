// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How far a picture depends on the order that its surfaces were drawn in: an order-independent technique has none.
/// Given pictures of one scene, drawn in shuffled orders; the first is the baseline.
#include <pellucid/measure/image_error.hpp>
#include <algorithm>
#include <span>

namespace pellucid::inline v0_1::measure {

/// Values are compared across all orders, so that two orders that differ from the baseline in opposite directions
/// count with their whole distance: the spread of a value is its largest minus its least over the orders.
/// A value that is not finite in any order enters `nonfinite` and the counts of differences, no spread.
struct OrderVariance {
    std::uint64_t orders = 0;            ///< pictures, baseline included
    std::uint64_t pixels = 0;            ///< of each picture
    std::uint64_t different_orders = 0;  ///< pictures with any bit unlike the baseline
    std::uint64_t different_pixels = 0;  ///< pixels with any bit unlike the baseline in any order
    std::uint64_t different_values = 0;  ///< the same, of values
    std::uint64_t nonfinite = 0;         ///< values that are NaN or infinite in any order
    double max_difference = 0;           ///< largest spread
    std::uint32_t max_ulp = 0;           ///< largest spread as ulp distance; of a value of its own
    std::uint32_t max_bits = 0;          ///< most bits of one value unlike the baseline, of 32
    /// Where `max_difference` is first; `value` and `reference` are the largest and the least there.
    WorstPixel worst;

    /// Every order has the same bits.
    [[nodiscard]] bool bit_equal() const noexcept { return different_values == 0; }
};

/// `pictures`: at least two, all `[h, w, c]` of one shape, c in 1 … 4.
/// Errors: invalid_argument where there are fewer or a shape differs from the first.
[[nodiscard]] inline Result<OrderVariance> order_variance(std::span<const ImageF> pictures);

/// One JSON object with the members' names.
[[nodiscard]] inline std::string to_json(const OrderVariance& variance);

// ---------------------------------------------------------------------------------------------------- bodies

Result<OrderVariance> order_variance(std::span<const ImageF> pictures) {
    if (pictures.size() < 2)
        return Error{Errc::invalid_argument, "order variance: " + std::to_string(pictures.size()) +
                                                 " pictures were given, but at least 2 orders are needed to differ"};
    const ImageF& first = pictures.front();
    OrderVariance result{.orders = pictures.size(), .pixels = std::uint64_t{first.width} * first.height};
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        const std::string what = "order variance, order " + std::to_string(i) + " against the baseline";
        PELLUCID_CHECK(detail::check_shapes(pictures[i], first, nullptr, what.c_str()));
        const auto alike = [](float a, float b) {
            return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
        };
        result.different_orders += !std::equal(first.data.begin(), first.data.end(), pictures[i].data.begin(), alike);
    }
    const std::size_t channels = first.channels;
    for (std::size_t pixel = 0; pixel < result.pixels; ++pixel) {
        bool different_pixel = false;
        for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t at = pixel * channels + c;
            const auto baseline = std::bit_cast<std::uint32_t>(first.data[at]);
            float least = first.data[at], most = least;
            bool finite = true, different = false;
            for (const ImageF& picture : pictures) {
                const float value = picture.data[at];
                const int bits = std::popcount(baseline ^ std::bit_cast<std::uint32_t>(value));
                result.max_bits = std::max(result.max_bits, static_cast<std::uint32_t>(bits));
                different |= bits != 0;
                finite &= std::isfinite(value);
                least = std::min(least, value);
                most = std::max(most, value);
            }
            result.different_values += different;
            different_pixel |= different;
            result.nonfinite += !finite;
            if (!finite) continue;
            result.max_ulp = std::max(result.max_ulp, ulp_distance(least, most));
            const double spread = static_cast<double>(most) - static_cast<double>(least);
            if (spread > result.max_difference) {
                result.max_difference = spread;
                result.worst = {static_cast<std::uint32_t>(pixel % first.width),
                                static_cast<std::uint32_t>(pixel / first.width), static_cast<std::uint32_t>(c), most,
                                least};
            }
        }
        result.different_pixels += different_pixel;
    }
    return result;
}

std::string to_json(const OrderVariance& variance) {
    detail::JsonObject object;
    object.add("orders", variance.orders).add("pixels", variance.pixels);
    object.add("different_orders", variance.different_orders).add("different_pixels", variance.different_pixels);
    object.add("different_values", variance.different_values).add("nonfinite", variance.nonfinite);
    object.add("max_difference", variance.max_difference).add("max_ulp", std::uint64_t{variance.max_ulp});
    object.add("max_bits", std::uint64_t{variance.max_bits}).raw("worst", detail::to_json(variance.worst));
    return object.close();
}

}  // namespace pellucid::inline v0_1::measure
