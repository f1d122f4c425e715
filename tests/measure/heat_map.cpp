// SPDX-License-Identifier: MIT
#include <pellucid/measure/heat_map.hpp>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;

namespace {
/// Relative luminance of an sRGB colour.
double luminance(Rgb8 color) {
    const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color[0] / 255.0) + 0.7152 * linear(color[1] / 255.0) + 0.0722 * linear(color[2] / 255.0);
}
Rgb8 pixel(const HeatMap& map, std::uint32_t x) {
    const std::uint8_t* p = map.rgb.texel(x, 0);
    return {p[0], p[1], p[2]};
}
ImageF row(std::vector<float> values) {
    ImageF image(static_cast<std::uint32_t>(values.size()), 1, 1);
    image.data = std::move(values);
    return image;
}
constexpr Rgb8 black{0, 0, 0}, magenta{255, 0, 255};
}  // namespace

TEST_CASE("a larger error is never darker", "[cpu]") {
    double last = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double now = luminance(heat_color(i / 1000.0));
        // Between two codes one channel may round down while another waits.
        REQUIRE(now > last - 0.003);
        last = now;
    }
    for (int i = 0; i < 16; ++i) CHECK(luminance(heat_color((i + 1) / 16.0)) > 1.1 * luminance(heat_color(i / 16.0)));
    CHECK(heat_color(-1) == heat_color(0));
    CHECK(heat_color(2) == heat_color(1));
    CHECK(heat_color(std::numeric_limits<double>::quiet_NaN()) == heat_color(0));
    CHECK(heat_color(1) == Rgb8{248, 248, 248});
    CHECK(heat_color(0.5) == Rgb8{198, 44, 88});
    CHECK(heat_color(0) != black);
}

TEST_CASE("the logarithmic scale spans four decades below the largest error", "[cpu]") {
    const HeatMap map = heat_map(row({0, 1e-9f, 2e-3f, 0.2f, 20, NAN, INFINITY}));
    CHECK(map.scale == HeatScale::logarithmic);
    CHECK(map.high == 20);
    CHECK(map.low == Approx(2e-3).epsilon(1e-12));
    CHECK(pixel(map, 0) == black);
    CHECK(pixel(map, 1) == heat_color(0));
    CHECK(pixel(map, 2) == heat_color(0));
    CHECK(pixel(map, 3) == heat_color(0.5));
    CHECK(pixel(map, 4) == heat_color(1));
    CHECK(pixel(map, 5) == magenta);
    CHECK(pixel(map, 6) == magenta);
}

TEST_CASE("the linear scale and given limits", "[cpu]") {
    const HeatMap map = heat_map(row({0.5f, 1, 4}), {.scale = HeatScale::linear, .high = 2});
    CHECK(map.low == 0);
    CHECK(map.high == 2);
    CHECK(pixel(map, 0) == heat_color(0.25));
    CHECK(pixel(map, 1) == heat_color(0.5));
    CHECK(pixel(map, 2) == heat_color(1));
    const HeatMap log = heat_map(row({0.01f, 0.1f, 1}), {.low = 0.01, .high = 1});
    CHECK(pixel(log, 1) == heat_color(0.5));
}

TEST_CASE("pictures without an error, or with one value, have a map", "[cpu]") {
    const HeatMap none = heat_map(row({0, 0}));
    CHECK(none.high == 0);
    CHECK(pixel(none, 0) == black);
    const HeatMap same = heat_map(row({3, 3}), {.low = 3});
    CHECK(pixel(same, 0) == heat_color(1));
    CHECK(heat_map(ImageF{}).rgb.empty());
    CHECK(pixel(heat_map(row({NAN})), 0) == magenta);
}
