// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The colours of FLIP: from linear RGB (sRGB primaries) to the two spaces the metric works in, and its distance of two
/// colours.  After Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator
/// for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), article 15, 2020: its colour pipeline. Where
/// the paper leaves a choice (borders, normalisation, matrices), as in the authors' implementation, NVlabs/flip.  White
/// is D65, the XYZ of RGB (1,1,1) itself, so that grey has no chroma.
#include <algorithm>
#include <array>
#include <cmath>

namespace pellucid::inline v0_1::measure::flip {

/// A colour, or a row of a matrix.
using Vec3 = std::array<double, 3>;
using Mat3 = std::array<Vec3, 3>;  ///< rows

/// m v.
[[nodiscard]] constexpr Vec3 multiply(const Mat3& m, const Vec3& v) noexcept {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

/// By the adjugate.  Precondition: not singular.
[[nodiscard]] constexpr Mat3 inverse(const Mat3& m) noexcept {
    Mat3 result{};
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
            result[i][j] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
            if (j == 0) determinant += m[0][i] * result[i][0];
        }
    for (Vec3& row : result)
        for (double& value : row) value /= determinant;
    return result;
}

/// Linear RGB → CIE XYZ of the sRGB primaries and D65 (IEC 61966-2-1), as exact fractions.
inline constexpr Mat3 xyz_from_rgb = {{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                       {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                       {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};
inline constexpr Mat3 rgb_from_xyz = inverse(xyz_from_rgb);
/// XYZ of RGB (1,1,1).
inline constexpr Vec3 white_xyz = multiply(xyz_from_rgb, {1, 1, 1});

/// The paper's constants: exponent q_c of the distance; p_c, the share of the largest distance that is spread over the
/// share p_t of the error's range.
inline constexpr double color_exponent = 0.7, break_distance = 0.4, break_error = 0.95;

/// YyCxCz (Kolpatzik and Bouman 1992), CIELAB without its cube roots: Yy = 116 Y/Yn − 16, Cx = 500 (X/Xn − Y/Yn),
/// Cz = 200 (Y/Yn − Z/Zn).  Linear in light, so that it may be filtered.
[[nodiscard]] constexpr Vec3 ycxcz_from_rgb(const Vec3& rgb) noexcept {
    const Vec3 xyz = multiply(xyz_from_rgb, rgb);
    const double x = xyz[0] / white_xyz[0], y = xyz[1] / white_xyz[1], z = xyz[2] / white_xyz[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// The inverse of the conversion to YyCxCz, to linear RGB.
[[nodiscard]] constexpr Vec3 rgb_from_ycxcz(const Vec3& color) noexcept {
    const double y = (color[0] + 16) / 116;
    return multiply(rgb_from_xyz,
                    {(y + color[1] / 500) * white_xyz[0], y * white_xyz[1], (y - color[2] / 200) * white_xyz[2]});
}

/// CIELAB (CIE 15) of linear RGB.
[[nodiscard]] inline Vec3 lab_from_rgb(const Vec3& rgb) noexcept {
    constexpr double delta = 6.0 / 29;
    const Vec3 xyz = multiply(xyz_from_rgb, rgb);
    Vec3 f;
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = xyz[i] / white_xyz[i];
        f[i] = t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// The Hunt effect: chroma counts in proportion to lightness, (L, 0.01 L a, 0.01 L b).
[[nodiscard]] constexpr Vec3 hunt_adjusted(const Vec3& lab) noexcept {
    return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]};
}

/// HyAB distance (Abasi, Amani Tehran and Fairchild 2020): |ΔL| + √(Δa² + Δb²).  Symmetric, 0 only for equal colours.
[[nodiscard]] inline double hyab(const Vec3& a, const Vec3& b) noexcept {
    const double da = a[1] - b[1], db = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

/// c_max: the largest distance in the sRGB gamut, green from blue, to the power q_c: 41.2761.
[[nodiscard]] inline double max_color_distance() noexcept {
    static const double distance =
        std::pow(hyab(hunt_adjusted(lab_from_rgb({0, 1, 0})), hunt_adjusted(lab_from_rgb({0, 0, 1}))), color_exponent);
    return distance;
}

/// A HyAB distance of Hunt-adjusted colours ≥ 0 → error ΔE_c in [0,1]: the distance to the power q_c, of which
/// [0, p_c c_max) is mapped to [0, p_t) and the rest to [p_t, 1], both linearly.  Increasing.
[[nodiscard]] inline double color_error(double distance) noexcept {
    const double power = std::pow(distance, color_exponent), bend = break_distance * max_color_distance();
    if (power < bend) return break_error * power / bend;
    return std::min(break_error + (1 - break_error) * (power - bend) / (max_color_distance() - bend), 1.0);
}

}  // namespace pellucid::inline v0_1::measure::flip
