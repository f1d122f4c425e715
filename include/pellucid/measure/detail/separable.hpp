// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Filters of one dimension, along rows or along columns of a plane `[h, w, 1]` of doubles.  Beyond the border lies the
/// nearest pixel of the border, so any size from 1 × 1 has an answer.
#include <algorithm>
#include <cassert>
#include <pellucid/core/image.hpp>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::measure::detail {

using Plane = Image<double>;

/// out(x, y) = Σ_k kernel[radius + k] in(x + k, y), k in −radius … radius.  Precondition: an odd number of weights.
[[nodiscard]] inline Plane filter_rows(const Plane& in, std::span<const double> kernel) {
    assert(in.channels == 1 && kernel.size() % 2 == 1);
    Plane out(in.width, in.height, 1);
    if (in.empty()) return out;
    const std::size_t radius = kernel.size() / 2, width = in.width;
    std::vector<double> padded(width + 2 * radius);
    for (std::uint32_t y = 0; y < in.height; ++y) {
        const double* row = in.texel(0, y);
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
        std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
        double* target = out.texel(0, y);
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const double weight = kernel[k];
            const double* source = padded.data() + k;
            for (std::size_t x = 0; x < width; ++x) target[x] += weight * source[x];
        }
    }
    return out;
}

/// out(x, y) = Σ_k kernel[radius + k] in(x, y + k), k in −radius … radius.  Precondition: an odd number of weights.
[[nodiscard]] inline Plane filter_columns(const Plane& in, std::span<const double> kernel) {
    assert(in.channels == 1 && kernel.size() % 2 == 1);
    Plane out(in.width, in.height, 1);
    const auto radius = static_cast<std::int64_t>(kernel.size() / 2), last = std::int64_t{in.height} - 1;
    for (std::int64_t y = 0; y <= last; ++y) {
        double* target = out.texel(0, static_cast<std::uint32_t>(y));
        for (std::int64_t k = -radius; k <= radius; ++k) {
            const double weight = kernel[static_cast<std::size_t>(radius + k)];
            const double* source = in.texel(0, static_cast<std::uint32_t>(std::clamp<std::int64_t>(y + k, 0, last)));
            for (std::size_t x = 0; x < in.width; ++x) target[x] += weight * source[x];
        }
    }
    return out;
}

}  // namespace pellucid::inline v0_1::measure::detail
