// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Signs of small determinants, exact for the doubles given: which side of an edge a pixel centre lies on has one
/// answer, whatever the order of the vertices, the compiler or the processor.
///
/// A product of doubles is the unevaluated sum of two doubles, and sums of doubles are kept as lists of doubles whose
/// bits do not overlap (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", theorems 6, 10 and 18).  Precondition of all: elements are finite, and 0 or of magnitude 1e-90 … 1e90,
/// so that no product of three leaves the range of double; and the compiler keeps IEEE 754 (no -ffast-math).
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

namespace pellucid::inline v0_1::reference {

/// p q − r s to 1.5 ulp, also where the products cancel (Kahan; Jeannerod, Louvet and Muller 2013).
[[nodiscard]] inline double difference_of_products(double p, double q, double r, double s) noexcept {
    const double product = r * s;
    const double lost = std::fma(-r, s, product);
    return std::fma(p, q, -product) + lost;
}

/// −1, 0 or 1: the sign of p q − r s.
[[nodiscard]] inline int sign_of_difference(double p, double q, double r, double s) noexcept;

/// −1, 0 or 1: the sign of the determinant with the columns a, b, c, which is a · (b × c).
[[nodiscard]] inline int sign_of_determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// value + error is exactly the sum, or the product.
struct Exact {
    double value, error;
};
[[nodiscard]] inline Exact two_sum(double a, double b) noexcept {
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}
[[nodiscard]] inline Exact two_product(double a, double b) noexcept {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

/// The exact sum of at most `N` doubles; components grow in magnitude and their bits do not overlap.
template <std::size_t N>
class Expansion {
public:
    void add(double value) noexcept {
        double carried = value;
        for (std::size_t i = 0; i < size_; ++i) {
            const Exact e = two_sum(carried, components_[i]);
            components_[i] = e.error;
            carried = e.value;
        }
        components_[size_++] = carried;
    }
    [[nodiscard]] int sign() const noexcept {
        for (std::size_t i = size_; i-- > 0;)
            if (components_[i] != 0) return components_[i] > 0 ? 1 : -1;
        return 0;
    }

private:
    std::array<double, N> components_{};
    std::size_t size_ = 0;
};

}  // namespace detail

int sign_of_difference(double p, double q, double r, double s) noexcept {
    const detail::Exact a = detail::two_product(p, q), b = detail::two_product(-r, s);
    detail::Expansion<4> sum;
    for (const double value : {a.value, a.error, b.value, b.error}) sum.add(value);
    return sum.sign();
}

int sign_of_determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) noexcept {
    detail::Expansion<24> sum;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (const detail::Exact& minor : {detail::two_product(b[j], c[k]), detail::two_product(-b[k], c[j])})
            for (const double part : {minor.value, minor.error}) {
                const detail::Exact term = detail::two_product(a[i], part);
                sum.add(term.value);
                sum.add(term.error);
            }
    }
    return sum.sign();
}

}  // namespace pellucid::inline v0_1::reference
