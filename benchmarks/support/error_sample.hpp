// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Errors of sampled values against a reference, and which pixels are sampled.
#include <pellucid/core/image.hpp>
#include <pellucid/measure/statistics.hpp>
#include <vector>

namespace pellucid::bench {

/// Absolute errors; values that are not finite are counted apart and never averaged.
class ErrorSample {
public:
    void add(double error) {
        if (std::isfinite(error))
            errors_.push_back(std::abs(error));
        else
            ++nonfinite_;
    }
    /// |value - reference| / max(1, |reference|).
    void add_scaled(double value, double reference) { add((value - reference) / std::max(1.0, std::abs(reference))); }
    [[nodiscard]] std::size_t count() const noexcept { return errors_.size(); }
    [[nodiscard]] std::size_t nonfinite() const noexcept { return nonfinite_; }
    [[nodiscard]] double rms() const {
        double sum = 0;
        for (const double e : errors_) sum += e * e;
        return errors_.empty() ? 0 : std::sqrt(sum / static_cast<double>(errors_.size()));
    }
    [[nodiscard]] double max() const { return errors_.empty() ? 0 : *std::max_element(errors_.begin(), errors_.end()); }
    [[nodiscard]] double p999() const {
        std::vector<double> copy = errors_;
        return measure::nearest_rank(copy, 0.999);
    }
    /// Something was compared, all of it was finite, and nothing is further off than `limit`.
    [[nodiscard]] bool within(double limit) const { return count() > 0 && nonfinite_ == 0 && max() <= limit; }

private:
    std::vector<double> errors_;
    std::size_t nonfinite_ = 0;
};

struct PixelAt {
    std::uint32_t x = 0, y = 0;
};

/// About `wanted` pixels spread over a picture (the R2 sequence of Roberts 2018), the corners first.
[[nodiscard]] inline std::vector<PixelAt> sample_pixels(Extent2D size, std::uint32_t wanted) {
    std::vector<PixelAt> out = {{0, 0}, {size.width - 1, 0}, {0, size.height - 1}, {size.width - 1, size.height - 1}};
    constexpr double g = 1.32471795724474602596;  // the plastic number: g³ = g + 1
    for (std::uint32_t i = 1; i <= wanted; ++i) {
        const double u = std::fmod(0.5 + i / g, 1.0), v = std::fmod(0.5 + i / (g * g), 1.0);
        out.push_back({static_cast<std::uint32_t>(u * size.width), static_cast<std::uint32_t>(v * size.height)});
    }
    return out;
}

}  // namespace pellucid::bench
