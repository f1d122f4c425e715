// SPDX-License-Identifier: MIT
#include <pellucid/measure/flip_color.hpp>
#include "support/catch.hpp"

using namespace pellucid::measure::flip;

namespace {
/// The eight corners of the cube and a grid in it.
std::vector<Vec3> grid(int steps) {
    std::vector<Vec3> colors;
    for (int r = 0; r <= steps; ++r)
        for (int g = 0; g <= steps; ++g)
            for (int b = 0; b <= steps; ++b)
                colors.push_back({double(r) / steps, double(g) / steps, double(b) / steps});
    return colors;
}
double distance(const Vec3& a, const Vec3& b) {
    return hyab(hunt_adjusted(lab_from_rgb(a)), hunt_adjusted(lab_from_rgb(b)));
}
}  // namespace

TEST_CASE("matrices and white have the published values", "[cpu]") {
    // Nine digits, from the authors' implementation (NVlabs/flip, FLIP.h).
    const Mat3 published = {{{3.241003275, -1.537398934, -0.498615861},
                             {-0.969224334, 1.875930071, 0.041554224},
                             {0.055639423, -0.204011202, 1.057148933}}};
    const Vec3 white = {0.950428545, 1, 1.088900371};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(white_xyz[i] == Approx(white[i]).margin(6e-10));
        for (std::size_t j = 0; j < 3; ++j) {
            // Their digits come from single precision: half a unit of it at 2 … 4 is 1.2e-7.
            CHECK(rgb_from_xyz[i][j] == Approx(published[i][j]).margin(1.2e-7));
            const double unit = multiply(rgb_from_xyz, {xyz_from_rgb[0][j], xyz_from_rgb[1][j], xyz_from_rgb[2][j]})[i];
            CHECK(unit == Approx(i == j ? 1 : 0).margin(1e-15));
        }
    }
}

TEST_CASE("grey has no chroma, and the spaces agree at black and white", "[cpu]") {
    for (const double v : {0.0, 1e-4, 0.18, 0.5, 1.0}) {
        const Vec3 y = ycxcz_from_rgb({v, v, v}), lab = lab_from_rgb({v, v, v});
        CHECK(y[0] == Approx(116 * v - 16).epsilon(1e-13));
        for (int c = 1; c < 3; ++c) {
            CHECK(std::abs(y[c]) < 1e-12);
            CHECK(std::abs(lab[c]) < 1e-12);
        }
    }
    CHECK(lab_from_rgb({0, 0, 0})[0] == Approx(0).margin(1e-14));
    CHECK(lab_from_rgb({1, 1, 1})[0] == Approx(100).epsilon(1e-14));
    CHECK(lab_from_rgb({0.18, 0.18, 0.18})[0] == Approx(49.4961).margin(5e-5));  // L* of 18 % grey
    for (const Vec3& color : grid(5)) {
        const Vec3 back = rgb_from_ycxcz(ycxcz_from_rgb(color));
        for (std::size_t c = 0; c < 3; ++c) REQUIRE(back[c] == Approx(color[c]).margin(1e-14));
    }
}

TEST_CASE("CIELAB of the primaries", "[cpu]") {
    // Red, green and blue of sRGB under D65, as tables of CIELAB list them.
    const Vec3 red = lab_from_rgb({1, 0, 0}), green = lab_from_rgb({0, 1, 0}), blue = lab_from_rgb({0, 0, 1});
    CHECK(red[0] == Approx(53.24).margin(0.005));
    CHECK(red[1] == Approx(80.09).margin(0.02));
    CHECK(red[2] == Approx(67.20).margin(0.02));
    CHECK(green[0] == Approx(87.73).margin(0.01));
    CHECK(green[1] == Approx(-86.18).margin(0.02));
    CHECK(green[2] == Approx(83.18).margin(0.02));
    CHECK(blue[0] == Approx(32.30).margin(0.005));
    CHECK(blue[1] == Approx(79.19).margin(0.02));
    CHECK(blue[2] == Approx(-107.86).margin(0.02));
}

TEST_CASE("the lightness curve has no step where its pieces meet", "[cpu]") {
    const double joint = 216.0 / 24389;
    const auto lightness = [](double v) { return lab_from_rgb({v, v, v})[0]; };
    CHECK(lightness(joint * (1 - 1e-12)) == Approx(8).margin(1e-9));
    CHECK(lightness(joint * (1 + 1e-12)) == Approx(8).margin(1e-9));
}

TEST_CASE("the largest distance is green from blue, and has its published value", "[cpu]") {
    // 41.2760963, single precision: jeremyong/flop, ColorCompare.hlsl.
    CHECK(max_color_distance() == Approx(41.2760963).epsilon(1e-7));
    const std::vector<Vec3> colors = grid(6);
    double largest = 0;
    for (const Vec3& a : colors)
        for (const Vec3& b : colors) largest = std::max(largest, distance(a, b));
    CHECK(std::pow(largest, color_exponent) == max_color_distance());
}

TEST_CASE("the distance is a distance", "[cpu]") {
    const std::vector<Vec3> colors = grid(3);
    for (const Vec3& a : colors)
        for (const Vec3& b : colors) {
            REQUIRE(distance(a, b) == distance(b, a));
            REQUIRE((distance(a, b) == 0) == (a == b));
            for (const Vec3& c : grid(1)) REQUIRE(distance(a, b) <= distance(a, c) + distance(c, b) + 1e-12);
        }
    CHECK(hyab({10, 3, 4}, {14, 0, 0}) == 9);
    CHECK(hunt_adjusted({50, 20, -8}) == Vec3{50, 10, -4});
}

TEST_CASE("errors are redistributed without a step", "[cpu]") {
    CHECK(color_error(0) == 0);
    const double largest = std::pow(max_color_distance(), 1 / color_exponent);
    CHECK(largest == Approx(203.3017).epsilon(1e-6));
    CHECK(color_error(largest) == Approx(1).epsilon(1e-12));
    CHECK(color_error(1e6) == 1);
    const double bend = std::pow(break_distance * max_color_distance(), 1 / color_exponent);
    CHECK(color_error(bend * (1 - 1e-12)) == Approx(0.95).margin(1e-10));
    CHECK(color_error(bend * (1 + 1e-12)) == Approx(0.95).margin(1e-10));
    CHECK(color_error(1) == Approx(0.95 / (0.4 * max_color_distance())).epsilon(1e-14));
    double last = -1;
    for (int i = 0; i <= 1000; ++i) {
        const double now = color_error(largest * i / 1000);
        REQUIRE(now > last);
        last = now;
    }
    // Black and white: ΔL = 100.
    CHECK(color_error(100) == Approx(0.9673797614921327).epsilon(1e-12));
}
