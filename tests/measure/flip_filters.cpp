// SPDX-License-Identifier: MIT
#include <numeric>
#include <pellucid/measure/flip_filters.hpp>
#include "support/catch.hpp"

using namespace pellucid::measure::flip;

namespace {
double total(const Kernel& kernel) {
    return std::accumulate(kernel.begin(), kernel.end(), 0.0);
}
double positive(const Kernel& kernel) {
    double sum = 0;
    for (const double w : kernel) sum += w > 0 ? w : 0;
    return sum;
}
/// Weights from the centre outwards, against printed digits.
void check_half(const Kernel& kernel, const std::vector<double>& printed, double margin) {
    const std::size_t centre = kernel.size() / 2;
    for (std::size_t i = 0; i < printed.size(); ++i) CHECK(kernel[centre + i] == Approx(printed[i]).margin(margin));
}
}  // namespace

TEST_CASE("pixels per degree", "[cpu]") {
    CHECK(default_pixels_per_degree ==
          Approx(67.0206).margin(5e-5));  // 67.0206451 in single precision: FlipBinding.CSharp
    CHECK(default_pixels_per_degree == Approx(3840 * std::acos(-1.0) / 180).epsilon(1e-14));
    CHECK(pixels_per_degree(1.4, 3840, 0.7) == Approx(2 * default_pixels_per_degree).epsilon(1e-14));
}

TEST_CASE("radii at the default distance", "[cpu]") {
    const ContrastFilters contrast = contrast_filters(default_pixels_per_degree);
    CHECK(contrast.y.size() == 21);  // ⌈3 · 0.045016° · 67.02⌉ = ⌈9.05⌉
    CHECK(contrast.cx.size() == 21);
    CHECK(contrast.cz[0].size() == 21);
    CHECK(contrast.cz[1].size() == 21);
    const FeatureFilters features = feature_filters(default_pixels_per_degree);
    CHECK(features.gaussian.size() == 19);  // ⌈3 · 0.041° · 67.02⌉ = ⌈8.24⌉
    CHECK(features.first.size() == 19);
    CHECK(features.second.size() == 19);
}

TEST_CASE("weights have published values", "[cpu]") {
    // jeremyong/flop prints eight digits: FeatureFilter.hlsl, made for 67 pixels a degree, and CSFFilter.hlsl, for 66.
    const FeatureFilters features = feature_filters(67);
    check_half(features.gaussian,
               {0.14530192, 0.13598623, 0.11147196, 0.08003564, 0.05033249, 0.02772429, 0.01337580, 0.00565231,
                0.00209209, 0.00067823},
               5.1e-9);
    check_half(features.first,
               {0, -0.12572107, -0.20611460, -0.22198204, -0.18613221, -0.12815738, -0.07419661, -0.03657945,
                -0.01547329, -0.00564333},
               5.1e-9);
    check_half(features.second,
               {-0.29897641, -0.24272794, -0.10778385, 0.03217138, 0.11763449, 0.13377647, 0.10521736, 0.06477641,
                0.03265116, 0.01377273},
               5.1e-9);
    const ContrastFilters contrast = contrast_filters(66);
    check_half(contrast.cz[0],
               {0.11730367, 0.11084383, 0.09352148, 0.07045487, 0.04739261, 0.02846493, 0.01526544, 0.00730985,
                0.00312541, 0.00119318},
               5.1e-9);
    check_half(contrast.cz[1],
               {0.08301017, 0.07581780, 0.05776847, 0.03671896, 0.01947017, 0.00861249, 0.00317810, 0.00097833,
                0.00025124, 0.00005382},
               5.1e-9);
    // Theirs for Yy and Cx end after four pixels, at less than 3 sigma of their own, and the cut weights, 3e-6 and 1e-5
    // on each side, are spread over the others.
    check_half(contrast.y, {0.39172750, 0.24189219, 0.05695543, 0.00511357, 0.00017506}, 4e-6);
    check_half(contrast.cx, {0.36889303, 0.24056897, 0.06672016, 0.00786960, 0.00039475}, 1.2e-5);
}

TEST_CASE("filters are normalised at any distance", "[cpu]") {
    for (const double ppd : {1.0, 2.5, 10.0, 33.0, default_pixels_per_degree, 250.0, 1000.0}) {
        const ContrastFilters contrast = contrast_filters(ppd);
        CHECK(total(contrast.y) == Approx(1).epsilon(1e-12));
        CHECK(total(contrast.cx) == Approx(1).epsilon(1e-12));
        const double a = total(contrast.cz[0]), b = total(contrast.cz[1]);
        CHECK(a * a + b * b == Approx(1).epsilon(1e-12));
        const FeatureFilters features = feature_filters(ppd);
        CHECK(total(features.gaussian) == Approx(1).epsilon(1e-12));
        CHECK(total(features.first) == Approx(0).margin(1e-12));
        CHECK(total(features.second) == Approx(0).margin(1e-12));
        CHECK(positive(features.first) == Approx(1).epsilon(1e-12));
        CHECK(positive(features.second) == Approx(1).epsilon(1e-12));
        for (const Kernel* kernel :
             {&contrast.y, &contrast.cx, &contrast.cz[0], &contrast.cz[1], &features.gaussian, &features.second})
            for (std::size_t i = 0; i < kernel->size(); ++i) REQUIRE((*kernel)[i] == (*kernel)[kernel->size() - 1 - i]);
        for (std::size_t i = 0; i < features.first.size(); ++i)
            REQUIRE(features.first[i] == Approx(-features.first[features.first.size() - 1 - i]).epsilon(1e-14));
    }
}

TEST_CASE("products of the factors are the two-dimensional filters", "[cpu]") {
    const double ppd = 20, pi = std::acos(-1.0);
    const ContrastFilters contrast = contrast_filters(ppd);
    const int radius = static_cast<int>(contrast.y.size() / 2);
    const auto weight = [&](double a, double b, int x, int y) {
        return a * std::sqrt(pi / b) * std::exp(-pi * pi * (x * x + y * y) / (ppd * ppd) / b);
    };
    double sum_y = 0, sum_z = 0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            sum_y += weight(1, 0.0047, x, y);
            sum_z += weight(34.1, 0.04, x, y) + weight(13.5, 0.025, x, y);
        }
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const auto i = static_cast<std::size_t>(x + radius), j = static_cast<std::size_t>(y + radius);
            REQUIRE(contrast.y[i] * contrast.y[j] == Approx(weight(1, 0.0047, x, y) / sum_y).margin(1e-15));
            REQUIRE(contrast.cz[0][i] * contrast.cz[0][j] + contrast.cz[1][i] * contrast.cz[1][j] ==
                    Approx((weight(34.1, 0.04, x, y) + weight(13.5, 0.025, x, y)) / sum_z).margin(1e-15));
        }
}
