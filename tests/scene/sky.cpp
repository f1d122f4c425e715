// SPDX-License-Identifier: MIT
/// \file
/// The sky's table against converged integrals: at its texels, between them, and how long it takes to make.
#include <pellucid/reference/sky.hpp>
#include <pellucid/scene/sky.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>
#include "support/catch.hpp"

using namespace pellucid;
using pellucid::reference::zonal_diffuse;
using pellucid::reference::zonal_prefiltered;

namespace {
/// The largest relative error of any channel.
double error_of(glm::dvec3 value, glm::dvec3 exact) {
    const glm::dvec3 e = value / exact - 1.0;
    return std::max({std::abs(e.x), std::abs(e.y), std::abs(e.z)});
}
}  // namespace

TEST_CASE("places in the table: its ends, its middle, and texel by texel", "[cpu]") {
    for (const double roughness : {0.0, 0.3, 1.0}) {
        CHECK(sky_column(1.0, roughness) == 63.0);
        CHECK(sky_column(-1.0, roughness) == 0.0);
        CHECK(sky_column(0.0, roughness) == 31.5);
        CHECK(sky_column(1e-300, roughness) == Approx(32));
        CHECK(sky_column(-1e-300, roughness) == Approx(31));
        CHECK(sky_column(1.5, roughness) == 63.0);
    }
    CHECK(sky_row(0.0) == 0.0);
    CHECK(sky_row(1.0) == 15.0);
    CHECK(sky_row(-1.0) == 0.0);
    CHECK(sky_row(2.0f) == 15.0f);
    double previous = -1;
    for (int i = -1000; i <= 1000; ++i) {
        const double column = sky_column(i / 1000.0, 0.4);
        CHECK(column > previous);
        previous = column;
    }
}

TEST_CASE("texels are the converged integrals; the first row is the sky, the last one diffuse light", "[cpu]") {
    const Sky sky;
    const auto zonal = [&](double y) { return sky_radiance(sky, y); };
    const ImageF table = make_sky_table(sky);
    REQUIRE((table.width == sky_columns && table.height == sky_rows && table.channels == 3));
    CHECK(table.data.size() * sizeof(float) <= 16384);
    double worst = 0;
    for (std::uint32_t row = 0; row < sky_rows; ++row) {
        const double roughness = std::pow(row / 15.0, 1 / 0.55);
        for (std::uint32_t column = 0; column < sky_columns; column += row % 3 + 1) {
            const double side = column < 32 ? -1 : 1, step = column < 32 ? 31 - column : column - 32;
            const double y = side * std::pow(step / 31, 1 / (0.3 + 0.4 * roughness));
            const float* t = table.texel(column, row);
            const glm::dvec3 texel(t[0], t[1], t[2]);
            const glm::dvec3 exact = zonal_prefiltered(zonal, y, roughness * roughness, 0.25);
            worst = std::max(worst, error_of(texel, exact));
            if (row == 0) CHECK(error_of(texel, sky_radiance(sky, y)) < 1e-6);
            if (row == 15) CHECK(error_of(texel, zonal_diffuse(zonal, y, 0.25)) < 1e-4);
        }
    }
    std::printf("sky table: texels within %.4f %%\n", worst * 100);
    CHECK(worst < 1e-4);
}

TEST_CASE("lookups are within 0.5 % of the converged integrals, everywhere", "[cpu]") {
    const Sky sky;
    const auto zonal = [&](double y) { return sky_radiance(sky, y); };
    const ImageF table = make_sky_table(sky);
    // Even in y, and crowded at the horizon; roughness crowded at 0, every third value between rows.
    std::vector<double> heights, roughnesses;
    for (int i = -50; i <= 50; ++i) {
        heights.push_back(i / 50.0);
        heights.push_back(std::copysign(std::pow(std::abs(i / 50.0), 3), i));
        heights.push_back(std::copysign(std::pow(std::abs(i / 50.0), 6), i));
    }
    for (int i = 0; i <= 46; ++i) roughnesses.push_back(std::pow(i / 46.0, 1.8));
    double worst = 0, worst_float = 0, worst_y = 0, worst_roughness = 0, sum = 0;
    for (const double roughness : roughnesses)
        for (const double y : heights) {
            const glm::dvec3 exact = zonal_prefiltered(zonal, y, roughness * roughness, 0.25);
            const double error = error_of(sample_sky_table(table, y, roughness), exact);
            sum += error;
            if (error > worst) worst = error, worst_y = y, worst_roughness = roughness;
            const glm::vec3 narrow = sample_sky_table(table, static_cast<float>(y), static_cast<float>(roughness));
            worst_float = std::max(worst_float, error_of(glm::dvec3(narrow), exact));
        }
    std::printf("sky table: lookups within %.3f %% (y %.5f, roughness %.4f), in float %.3f %%; mean %.4f %%\n",
                worst * 100, worst_y, worst_roughness, worst_float * 100,
                sum / static_cast<double>(heights.size() * roughnesses.size()) * 100);
    CHECK(worst < 0.005);
    CHECK(worst_float < 0.005);
    double worst_diffuse = 0;
    for (int i = -400; i <= 400; ++i)
        worst_diffuse = std::max(
            worst_diffuse, error_of(sample_sky_table(table, i / 400.0, 1.0), zonal_diffuse(zonal, i / 400.0, 0.25)));
    std::printf("sky table: diffuse within %.3f %%\n", worst_diffuse * 100);
    CHECK(worst_diffuse < 0.005);
}

TEST_CASE("a sky of one colour is that colour in the whole table", "[cpu]") {
    const ImageF table = make_sky_table({.horizon = {1, 2, 3}, .zenith = {1, 2, 3}, .nadir = {1, 2, 3}});
    for (std::size_t i = 0; i < table.data.size(); ++i) CHECK(table.data[i] == static_cast<float>(i % 3 + 1));
    // And the colours are where they belong.
    const ImageF up = make_sky_table({.horizon = {0, 0, 0}, .zenith = {0, 1, 0}, .nadir = {0, 0, 1}});
    const glm::dvec3 above = sample_sky_table(up, 0.9, 0.2), below = sample_sky_table(up, -0.9, 0.2);
    CHECK((above.x == 0 && above.y > 0.9 && above.z < 0.01));
    CHECK((below.x == 0 && below.y < 0.01 && below.z > 0.9));
    CHECK(above.y == below.z);
}

TEST_CASE("the table takes a few milliseconds", "[cpu]") {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const ImageF table = make_sky_table();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        CHECK(!table.empty());
        best = std::min(best, taken.count());
    }
    std::printf("sky table: made in %.2f ms\n", best);
#if !defined(__SANITIZE_ADDRESS__)
    CHECK(best < 50);
#endif
}
