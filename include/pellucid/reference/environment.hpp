// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Light from all around: environments as pictures or functions of direction, and what surfaces make of them, in
/// double.
///
/// The world's y is up.  A picture is equirectangular: row 0 at the top, +y; its left edge at longitude −π, so that
/// with the longitude atan2(z, x) a direction is at u = atan2(z, x)/2π + 1/2, v = acos(y)/π.  The middle column is +x,
/// a quarter to the left of it −z.  That is what three.js (`equirectUv`) and Khronos' glTF IBL sampler (`dirToUV`) do.
///
/// A radiance function is any `glm::dvec3 f(glm::dvec3 unit_direction)`.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <pellucid/core/image.hpp>
#include <pellucid/reference/quadrature.hpp>

namespace pellucid::inline v0_1::reference {

/// Where `direction` (unit) is in a picture: u in [0,1], v in [0,1] from the top.  At the poles u is 1/2.
[[nodiscard]] inline glm::dvec2 equirect_uv(glm::dvec3 direction) noexcept;
/// The unit direction of a place in a picture; the inverse of `equirect_uv`.
[[nodiscard]] inline glm::dvec3 equirect_direction(glm::dvec2 uv) noexcept;

/// Radiance from `direction` (unit): texels are at the middle of their squares, bilinear between them, the left edge
/// joins the right one, rows beyond the first and the last are those.
/// Precondition: `check_environment(image)`.
[[nodiscard]] inline glm::dvec3 environment_radiance(const ImageF& image, glm::dvec3 direction) noexcept;

/// Two unit vectors that make a right-handed frame with `axis` (unit): x × y = axis (Duff et al. 2017).
template <std::floating_point T>
struct BasicFrame {
    glm::vec<3, T> x, y, axis;
    explicit BasicFrame(glm::vec<3, T> unit) noexcept : axis(unit) {
        const T sign = std::copysign(T(1), unit.z), a = T(-1) / (sign + unit.z), b = unit.x * unit.y * a;
        x = {T(1) + sign * unit.x * unit.x * a, sign * b, -sign * unit.x};
        y = {b, sign + unit.y * unit.y * a, -unit.y};
    }
    [[nodiscard]] glm::vec<3, T> to_world(glm::vec<3, T> local) const noexcept {
        return x * local.x + y * local.y + axis * local.z;
    }
};
/// In double.
using Frame = BasicFrame<double>;

/// How much of a lobe around R lies at the cosine μ = R·L, by solid angle and not normalised, under the usual
/// assumption N = V = R (Karis 2013): half vectors are distributed as D(H)(N·H), which gives L the density D(H)/4, and
/// samples weigh N·L: D(H) max(μ, 0)/4, with (N·H)² = (1 + μ)/2.  `one_minus_mu` = 1 − μ, given apart to keep its
/// digits. α in (0,1].
[[nodiscard]] inline double prefilter_weight(double one_minus_mu, double alpha) noexcept;

/// ∫ prefilter_weight over the sphere: what weights are divided by.  In closed form: with a = α² and u uniform,
/// μ(u) = (1 − u(1+a))/(1 − u(1−a)) over u < 1/(1+a).
[[nodiscard]] inline double prefilter_total(double alpha) noexcept;

/// The outgoing radiance of a white perfect diffuser, E(n)/π = (1/π) ∫ L(l) max(n·l, 0) dl, of a radiance function: a
/// product of `points` Gauss points of the height and 2·`points` equal steps around, which converges quickly where L is
/// smooth.
template <class Radiance>
[[nodiscard]] glm::dvec3 diffuse_radiance(const Radiance& radiance, glm::dvec3 normal, std::size_t points = 64);

/// The GGX-prefiltered radiance around `axis` = R: ∫ L w dl / ∫ w dl, w of `prefilter_weight`; the first factor of
/// Karis' split sum.  α = 0 is radiance(axis).  `points` as above, graded towards the axis.
template <class Radiance>
[[nodiscard]] glm::dvec3 prefiltered_radiance(const Radiance& radiance, glm::dvec3 axis, double alpha,
                                              std::size_t points = 64);

/// ∫ weight(l) L(l) dl over a picture, weight(direction) a number: `points`² Gauss points in each square between four
/// texels' middles, where bilinear radiance is a polynomial; so also right where one texel outshines all others.
template <class Weight>
[[nodiscard]] glm::dvec3 integrate_image(const ImageF& image, const Weight& weight, std::size_t points = 2);

/// `diffuse_radiance` and `prefiltered_radiance` of a picture by `integrate_image`.  Precondition: α is not small
/// against the texels, α >= π/height or so; below that take the ones above with `environment_radiance`.
[[nodiscard]] inline glm::dvec3 diffuse_radiance(const ImageF& image, glm::dvec3 normal, std::size_t points = 2);
[[nodiscard]] inline glm::dvec3 prefiltered_radiance(const ImageF& image, glm::dvec3 axis, double alpha,
                                                     std::size_t points = 2);

// ---------------------------------------------------------------------------------------------------- bodies

glm::dvec2 equirect_uv(glm::dvec3 direction) noexcept {
    constexpr double pi = std::numbers::pi;
    // acos(y) as an angle between two sides, which has all its digits near the poles.
    const double level = std::hypot(direction.x, direction.z);
    return {std::atan2(direction.z, direction.x) / (2 * pi) + 0.5, std::atan2(level, direction.y) / pi};
}

glm::dvec3 equirect_direction(glm::dvec2 uv) noexcept {
    constexpr double pi = std::numbers::pi;
    const double longitude = 2 * pi * (uv.x - 0.5), colatitude = pi * uv.y, level = std::sin(colatitude);
    return {level * std::cos(longitude), std::cos(colatitude), level * std::sin(longitude)};
}

glm::dvec3 environment_radiance(const ImageF& image, glm::dvec3 direction) noexcept {
    const glm::dvec2 uv = equirect_uv(direction);
    const double x = uv.x * image.width - 0.5, y = uv.y * image.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto column = [&](double at) {
        const auto w = static_cast<std::int64_t>(image.width);
        return static_cast<std::uint32_t>((static_cast<std::int64_t>(at) % w + w) % w);
    };
    const auto row = [&](double at) { return static_cast<std::uint32_t>(std::clamp(at, 0.0, image.height - 1.0)); };
    const auto texel = [&](double i, double j) {
        const float* t = image.texel(column(i), row(j));
        return glm::dvec3(t[0], t[1], t[2]);
    };
    const double fx = x - left, fy = y - top;
    const glm::dvec3 upper = texel(left, top) * (1 - fx) + texel(left + 1, top) * fx;
    const glm::dvec3 lower = texel(left, top + 1) * (1 - fx) + texel(left + 1, top + 1) * fx;
    return upper * (1 - fy) + lower * fy;
}

double prefilter_weight(double one_minus_mu, double alpha) noexcept {
    const double mu = 1 - one_minus_mu;
    if (!(mu > 0)) return 0;
    const double a2 = alpha * alpha, sine2 = 0.5 * one_minus_mu, q = sine2 + (1 - sine2) * a2;
    return a2 * mu / (4 * std::numbers::pi * q * q);
}

double prefilter_total(double alpha) noexcept {
    const double a = alpha * alpha, c = 1 - a, end = 1 / (1 + a);
    // (1 − (1+a)u)/(1 − cu) = (1+a)/c − (2a/c)/(1 − cu), which cancels where a is near 1: there term by term in c.
    if (c > 0.5) return 1 / c + 2 * a / (c * c) * std::log(2 * a * end);
    double sum = 0, power = end;
    for (int k = 0; k < 40; ++k, power *= c * end) sum += power / ((k + 1) * (k + 2));
    return sum;
}

template <class Radiance>
glm::dvec3 diffuse_radiance(const Radiance& radiance, glm::dvec3 normal, std::size_t points) {
    const Frame frame(normal);
    const QuadratureRule rule = gauss_legendre(points);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < points; ++i)
        for (std::size_t j = 0; j < 2 * points; ++j) {
            const double cosine = rule.at[i], sine = std::sqrt((1 - cosine) * (1 + cosine));
            const double phi = std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(points);
            sum += radiance(frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine})) *
                   (2 * cosine * rule.weight[i]);
        }
    return sum / (2.0 * static_cast<double>(points));
}

template <class Radiance>
glm::dvec3 prefiltered_radiance(const Radiance& radiance, glm::dvec3 axis, double alpha, std::size_t points) {
    if (!(alpha > 0)) return radiance(axis);
    const Frame frame(axis);
    const QuadratureRule rule = gauss_legendre(points);
    // tan θ_h = α tan ψ makes D(H)(N·H) uniform in sin²ψ; N·L > 0 ends at θ_h = 45°.  ψ = ψ_end t².
    const double end = std::atan(1 / alpha);
    glm::dvec3 sum(0.0);
    double total = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const double t = rule.at[i], psi = end * t * t;
        const double theta = 2 * std::atan(alpha * std::tan(psi)), mu = std::cos(theta);
        const double weight = rule.weight[i] * t * std::sin(2 * psi) * mu;
        glm::dvec3 ring(0.0);
        for (std::size_t j = 0; j < 2 * points; ++j) {
            const double phi = std::numbers::pi * (static_cast<double>(j) + 0.5) / static_cast<double>(points);
            ring += radiance(frame.to_world({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), mu}));
        }
        sum += ring * (weight / (2.0 * static_cast<double>(points)));
        total += weight;
    }
    return sum / total;
}

template <class Weight>
glm::dvec3 integrate_image(const ImageF& image, const Weight& weight, std::size_t points) {
    const QuadratureRule rule = gauss_legendre(points);
    const double w = image.width, h = image.height, area = 2 * std::numbers::pi * std::numbers::pi / (w * h);
    glm::dvec3 sum(0.0);
    // Rows of squares between texels' middles; above the first and below the last half a square is left.
    for (std::uint32_t row = 0; row <= image.height; ++row) {
        const double first = std::max(row - 0.5, 0.0), last = std::min(row + 0.5, h);
        for (std::size_t j = 0; j < points; ++j) {
            const double v = (first + (last - first) * rule.at[j]) / h;
            const double strip = area * (last - first) * rule.weight[j] * std::sin(std::numbers::pi * v);
            for (std::uint32_t column = 0; column < image.width; ++column)
                for (std::size_t i = 0; i < points; ++i) {
                    const glm::dvec3 direction = equirect_direction({(column - 0.5 + rule.at[i]) / w, v});
                    const double factor = weight(direction);
                    if (factor != 0) sum += environment_radiance(image, direction) * (factor * strip * rule.weight[i]);
                }
        }
    }
    return sum;
}

glm::dvec3 diffuse_radiance(const ImageF& image, glm::dvec3 normal, std::size_t points) {
    return integrate_image(
        image, [&](glm::dvec3 l) { return std::max(glm::dot(normal, l), 0.0) / std::numbers::pi; }, points);
}

/// The GGX-prefiltered radiance of a picture around `axis`.
glm::dvec3 prefiltered_radiance(const ImageF& image, glm::dvec3 axis, double alpha, std::size_t points) {
    const auto weight = [&](glm::dvec3 l) {
        const glm::dvec3 difference = axis - l;
        return prefilter_weight(0.5 * glm::dot(difference, difference), alpha);
    };
    return integrate_image(image, weight, points) / prefilter_total(alpha);
}

}  // namespace pellucid::inline v0_1::reference
