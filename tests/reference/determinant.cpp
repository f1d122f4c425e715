// SPDX-License-Identifier: MIT
#include <cstdint>
#include <glm/geometric.hpp>
#include <pellucid/reference/determinant.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid::reference;
using pellucid::test::Random;

namespace {

__extension__ typedef __int128 Wide;
int sign_of(Wide value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}
/// Whole numbers of up to `bits` bits.
std::int64_t whole(Random& random, int bits) {
    const double limit = std::ldexp(1.0, bits);
    return static_cast<std::int64_t>(random.uniform(-limit, limit));
}
struct Column {
    std::int64_t v[3];
    [[nodiscard]] glm::dvec3 real() const {
        return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
    }
};
Wide determinant(const Column& a, const Column& b, const Column& c) {
    Wide sum = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += Wide{a.v[i]} * (Wide{b.v[j]} * c.v[k] - Wide{b.v[k]} * c.v[j]);
    }
    return sum;
}

}  // namespace

TEST_CASE("signs of 3x3 determinants are those of whole-number arithmetic", "[cpu]") {
    Random random(1);
    int zeros = 0, naive_wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        Column a{}, b{}, c{};
        for (int r = 0; r < 3; ++r) a.v[r] = whole(random, 38), b.v[r] = whole(random, 38);
        // c in the plane of a and b, give or take one unit in one place: the hardest signs there are.
        const std::int64_t p = whole(random, 1), q = whole(random, 1);
        for (int r = 0; r < 3; ++r) c.v[r] = p * a.v[r] + q * b.v[r];
        c.v[i % 3] += whole(random, 1);
        const int expected = sign_of(determinant(a, b, c));
        const glm::dvec3 x = a.real(), y = b.real(), z = c.real();
        REQUIRE(sign_of_determinant(x, y, z) == expected);
        REQUIRE(sign_of_determinant(y, x, z) == -expected);
        REQUIRE(sign_of_determinant(z, x, y) == expected);
        zeros += expected == 0;
        const double naive = glm::dot(x, glm::cross(y, z));
        naive_wrong += (naive > 0) - (naive < 0) != expected;
    }
    CHECK(zeros > 1000);
    CHECK(naive_wrong > 1000);  // or the exact way would not be needed
}

TEST_CASE("signs of differences of products are exact", "[cpu]") {
    Random random(2);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t p = whole(random, 50), q = whole(random, 50), r = p + whole(random, 1),
                           s = q + whole(random, 1);
        const int expected = sign_of(Wide{p} * q - Wide{r} * s);
        const auto d = [](std::int64_t v) { return static_cast<double>(v); };
        REQUIRE(sign_of_difference(d(p), d(q), d(r), d(s)) == expected);
        REQUIRE(sign_of_difference(d(r), d(s), d(p), d(q)) == -expected);
    }
    CHECK(sign_of_difference(0, 1, 1, 0) == 0);
    CHECK(sign_of_difference(1e-90, 1e-90, 0, 1) == 1);
}

TEST_CASE("what is smaller than the rounding of what it is added to still decides", "[cpu]") {
    // 1e80 − 1e80 ± 1e-110.
    CHECK(sign_of_determinant({1e80, 1e80, 1e-80}, {1, 1, 0}, {0, 1e-30, 1}) == 1);
    CHECK(sign_of_determinant({1e80, 1e80, 1e-80}, {1, 1, 0}, {0, -1e-30, 1}) == -1);
    CHECK(sign_of_determinant({1e80, 1e80, 1e-80}, {1, 1, 0}, {0, 0, 1}) == 0);
    CHECK(sign_of_determinant({1, 0, 0}, {0, 1e80, 1e80}, {0, 1e80, 1e80}) == 0);
    CHECK(sign_of_determinant({1, 0, 0}, {0, 1e80, 1e80}, {0, 1e80, std::nextafter(1e80, 2e80)}) == 1);
    CHECK(sign_of_determinant({1e-30, 0, 0}, {0, 1, 0}, {0, 0, 1e-30}) == 1);
}

TEST_CASE("a difference of products keeps its digits where they cancel", "[cpu]") {
    Random random(3);
    for (int i = 0; i < 100000; ++i) {
        const std::int64_t p = whole(random, 52), q = whole(random, 52), r = p + whole(random, 2),
                           s = q + whole(random, 2);
        const auto d = [](std::int64_t v) { return static_cast<double>(v); };
        const long double exact = static_cast<long double>(Wide{p} * q - Wide{r} * s);
        const double found = difference_of_products(d(p), d(q), d(r), d(s));
        REQUIRE(std::abs(static_cast<long double>(found) - exact) <= 2 * 0x1p-52L * std::abs(exact));
    }
}
