// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The directional albedo of dfg.hpp as a table of size × size texels with two channels, and its averages by roughness.
///
/// Rows are roughness r, columns x = s (1 + r)/(s + r) with s = √μ; the first and last texel centres are at 0 and 1, so
/// the coordinate of a texture is (x (size − 1) + ½)/size.  For smooth surfaces E is a function of μ/α = (s/r)² alone:
/// in (μ, r) or (√μ, r) it has no limit in the corner μ = r = 0, and any such table is off by 0.106 there, whatever its
/// size.  x keeps μ/α and resolves it at every roughness.  What it does not resolve for smooth surfaces, the mirror's
/// (1 − μ)⁵, is left out of the table: a texel holds
///     loss  = 1 − scale − bias                      (so small losses keep their digits in binary16)
///     shift = bias − (1 − loss)(1 − μ)⁵             (how the width of the lobe changes Schlick's weight).
/// Largest error of E for F0 in {0, 0.04, 0.5, 1}, over all of [0,1]², with bilinear lookups of binary16 values: 0.0055
/// for 32², 0.0018 for 64², 0.0006 for 128² (of which rounding is 0.0005); over (√μ, r) 0.108, 0.108 and 0.106, and
/// where roughness is at least 0.045 it is 0.035, 0.010 and 0.0031.
#include <cstdint>
#include <pellucid/core/half.hpp>
#include <pellucid/reference/dfg.hpp>

namespace pellucid::inline v0_1::reference {

/// What a texel of the table holds.
struct DfgTexel {
    float loss = 0;
    float shift = 0;
};

/// What texels are rounded to.
enum class DfgStorage : std::uint8_t { float32, float16 };

/// The roughness that stands for 0 in the first row: its x still spans all μ/α.
inline constexpr double min_table_roughness = 1e-3;

/// The column coordinate, [0,1].  μ and r in [0,1].
template <std::floating_point T>
[[nodiscard]] T dfg_coordinate(T mu, T roughness) noexcept;

/// Its inverse in μ.  `x` in [0,1], r in [min_table_roughness,1].
template <std::floating_point T>
[[nodiscard]] T dfg_cosine(T x, T roughness) noexcept;

/// The directional albedo of the GGX lobe, over cosine and roughness.
class DfgTable {
public:
    /// No texels: that of a mirror at every roughness (loss 0, bias (1 − μ)⁵).
    DfgTable() = default;

    /// \param size texels a side, at least 2.
    /// \param storage float16 rounds texels and averages toward zero, as GPUs store them.
    /// \param integral (μ, α) -> Dfg<double>, called once for each texel.
    template <class Integral>
    [[nodiscard]] static DfgTable make(int size, DfgStorage storage, Integral&& integral);

    /// With integrals to 2e-6.
    [[nodiscard]] static DfgTable make(int size = 128, DfgStorage storage = DfgStorage::float32);

    [[nodiscard]] int size() const noexcept { return size_; }
    /// Row by row, roughness 0 first; μ = 0 first in a row.
    [[nodiscard]] const std::vector<DfgTexel>& texels() const noexcept { return texels_; }
    /// One for each row: 2∫E μ dμ of what a lookup in that row gives, so that what multiple scattering adds is exactly
    /// what the table says is lost.  In each cell between two texels μ² runs from one to the other; four points of
    /// Gauss' rule in x take Σ w E(x) d(μ²)/dx, the derivative being 4 s³ ds/dx, ds/dx = r (1 + r)/(1 + r − x)².
    [[nodiscard]] const std::vector<Dfg<float>>& averages() const noexcept { return averages_; }

    /// Bilinear.  Inputs are limited to [0,1]; NaN counts as 0.
    template <std::floating_point T>
    [[nodiscard]] Dfg<T> lookup(T mu, T roughness) const noexcept;

    /// Linear in roughness.  Without texels: loss 0, bias 1/21.
    template <std::floating_point T>
    [[nodiscard]] Dfg<T> average(T roughness) const noexcept;

private:
    [[nodiscard]] Dfg<double> average_of_row(int row, const GaussRule& rule) const;
    [[nodiscard]] double row_roughness(int row) const noexcept {
        return std::max(static_cast<double>(row) / (size_ - 1), min_table_roughness);
    }
    [[nodiscard]] const DfgTexel& texel(int column, int row) const noexcept {
        return texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) +
                       static_cast<std::size_t>(column)];
    }

    int size_ = 0;
    std::vector<DfgTexel> texels_;
    std::vector<Dfg<float>> averages_;
};

/// 128², float32, made on first use (half a second); what the reference renderer's `conserving` reads.
[[nodiscard]] inline const DfgTable& reference_dfg_table() {
    static const DfgTable table = DfgTable::make();
    return table;
}

// ---------------------------------------------------------------------------------------------------- bodies

template <std::floating_point T>
T dfg_coordinate(T mu, T roughness) noexcept {
    const T s = std::sqrt(mu);
    return s > T(0) ? s * (T(1) + roughness) / (s + roughness) : T(0);
}

template <std::floating_point T>
T dfg_cosine(T x, T roughness) noexcept {
    const T s = x * roughness / ((T(1) - x) + roughness);
    return s * s;
}

template <class Integral>
DfgTable DfgTable::make(int size, DfgStorage storage, Integral&& integral) {
    const auto stored = [storage](double value) {
        const auto single = static_cast<float>(value);
        return storage == DfgStorage::float16 ? half_to_float(half_toward_zero(single)) : single;
    };
    DfgTable out;
    out.size_ = size;
    out.texels_.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const double roughness = out.row_roughness(row);
            const double mu = dfg_cosine(static_cast<double>(column) / (size - 1), roughness);
            const Dfg<double> value = integral(mu, roughness * roughness);
            out.texels_.push_back({stored(value.loss), stored(value.bias - (1 - value.loss) * mirror_weight(mu))});
        }
    const GaussRule rule = gauss_rule(4);
    for (int row = 0; row < size; ++row) {
        const Dfg<double> average = out.average_of_row(row, rule);
        out.averages_.push_back({stored(average.loss), stored(average.bias)});
    }
    return out;
}

inline DfgTable DfgTable::make(int size, DfgStorage storage) {
    const GaussRule rule = gauss_rule(24);
    return make(size, storage, [&](double mu, double alpha) { return integrate_dfg(mu, alpha, rule); });
}

inline Dfg<double> DfgTable::average_of_row(int row, const GaussRule& rule) const {
    const double r = row_roughness(row);
    Dfg<double> out;
    for (int cell = 0; cell + 1 < size_; ++cell)
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double f = rule.nodes[i], x = (cell + f) / (size_ - 1), rest = (1 - x) + r;
            const double s = x * r / rest;
            const double weight = rule.weights[i] / (size_ - 1) * 4 * s * s * s * r * (1 + r) / (rest * rest);
            const DfgTexel &left = texel(cell, row), &right = texel(cell + 1, row);
            const double loss = left.loss + f * (right.loss - left.loss);
            const double shift = left.shift + f * (right.shift - left.shift);
            out.loss += weight * loss;
            out.bias += weight * (shift + (1 - loss) * mirror_weight(s * s));
        }
    return out;
}

template <std::floating_point T>
Dfg<T> DfgTable::lookup(T mu, T roughness) const noexcept {
    mu = mu > T(0) ? std::min(mu, T(1)) : T(0);
    roughness = roughness > T(0) ? std::min(roughness, T(1)) : T(0);
    if (size_ < 2) return {T(0), mirror_weight(mu)};
    const T x = dfg_coordinate(mu, roughness) * static_cast<T>(size_ - 1), y = roughness * static_cast<T>(size_ - 1);
    const int column = std::min(static_cast<int>(x), size_ - 2), row = std::min(static_cast<int>(y), size_ - 2);
    const T fx = x - static_cast<T>(column), fy = y - static_cast<T>(row);
    const auto blend = [&](float DfgTexel::*channel) {
        const auto along = [&](int at) {
            const T left = static_cast<T>(texel(column, at).*channel);
            return left + fx * (static_cast<T>(texel(column + 1, at).*channel) - left);
        };
        const T low = along(row);
        return low + fy * (along(row + 1) - low);
    };
    const T loss = std::clamp(blend(&DfgTexel::loss), T(0), T(1));
    const T bias = blend(&DfgTexel::shift) + (T(1) - loss) * mirror_weight(mu);
    return {loss, std::clamp(bias, T(0), T(1) - loss)};
}

template <std::floating_point T>
Dfg<T> DfgTable::average(T roughness) const noexcept {
    roughness = roughness > T(0) ? std::min(roughness, T(1)) : T(0);
    if (size_ < 2) return {T(0), T(1) / T(21)};
    const T y = roughness * static_cast<T>(size_ - 1);
    const int row = std::min(static_cast<int>(y), size_ - 2);
    const T f = y - static_cast<T>(row);
    const Dfg<float>&low = averages_[static_cast<std::size_t>(row)],
          &high = averages_[static_cast<std::size_t>(row) + 1];
    const auto blend = [f](float a, float b) {
        return static_cast<T>(a) + f * (static_cast<T>(b) - static_cast<T>(a));
    };
    return {blend(low.loss, high.loss), blend(low.bias, high.bias)};
}

}  // namespace pellucid::inline v0_1::reference
