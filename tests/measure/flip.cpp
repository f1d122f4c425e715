// SPDX-License-Identifier: MIT
#include <pellucid/measure/detail/flip_pictures.hpp>
#include <pellucid/measure/flip.hpp>
#include <pellucid/measure/flip_color.hpp>
#include "measure/flip_direct.hpp"
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
constexpr double ppd = flip::default_pixels_per_degree;

double mean(const ImageF& test, const ImageF& reference) {
    return (*ldr_flip(test, reference)).mean;
}
/// The error of uniform pictures: no feature, no filter.
double uniform_error(flip::Vec3 a, flip::Vec3 b) {
    return flip::color_error(
        flip::hyab(flip::hunt_adjusted(flip::lab_from_rgb(a)), flip::hunt_adjusted(flip::lab_from_rgb(b))));
}
Image<double> doubled(const ImageF& image) {
    Image<double> result(image.width, image.height, image.channels);
    std::copy(image.data.begin(), image.data.end(), result.data.begin());
    return result;
}
ImageF transposed(const ImageF& image) {
    ImageF result(image.height, image.width, image.channels);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            std::copy_n(image.texel(x, y), image.channels, result.texel(y, x));
    return result;
}
/// `background` with one white pixel.
ImageF dot(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y, float background = 0.2f) {
    ImageF image = grey(width, height, background);
    std::fill_n(image.texel(x, y), 3, 1.0f);
    return image;
}
}  // namespace

TEST_CASE("equal pictures have no error at all", "[cpu]") {
    for (const ImageF& picture :
         {noise(33, 9, 3, 1, -1, 3), grey(1, 1, 0), grey(5, 4, 1e4f),
          grey(2, 7, std::numeric_limits<float>::denorm_min()), noise(12, 12, 4, 2, 0, 1), noise(6, 5, 1, 3, 0, 1)}) {
        const FlipError error = *ldr_flip(picture, picture);
        CHECK(error.mean == 0);
        CHECK(error.max == 0);
        CHECK(error.weighted_median == 0);
        CHECK(error.pixels == std::uint64_t{picture.width} * picture.height);
    }
}

TEST_CASE("uniform pictures have the error of their colours, at any size and distance", "[cpu]") {
    const flip::Vec3 colors[] = {{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {0, 0, 1}, {0.25, 0.5, 0.125}};
    for (const auto& a : colors)
        for (const auto& b : colors)
            for (const Extent2D size : {Extent2D{1, 1}, {1, 40}, {3, 2}, {24, 5}}) {
                const auto picture = [&](const flip::Vec3& c) {
                    return uniform(size.width, size.height, static_cast<float>(c[0]), static_cast<float>(c[1]),
                                   static_cast<float>(c[2]));
                };
                for (const double distance : {1.0, ppd, 200.0}) {
                    const FlipError error = *ldr_flip(picture(a), picture(b), {.pixels_per_degree = distance});
                    // Filters sum to 1 within rounding, of which q_f takes the square root.
                    REQUIRE(error.mean == Approx(uniform_error(a, b)).margin(2e-7));
                    REQUIRE(error.max - error.min < 2e-7);
                }
            }
}

TEST_CASE("black from white, green from blue", "[cpu]") {
    CHECK(mean(grey(8, 8, 0), grey(8, 8, 1)) == Approx(0.9673797614921327).margin(2e-7));
    CHECK(mean(uniform(8, 8, 0, 1, 0), uniform(8, 8, 0, 0, 1)) == Approx(1).margin(2e-7));
}

TEST_CASE("a published value: 0.1 from 0.9", "[cpu]") {
    // OpenImageIO, testsuite/flip/ref/out.txt: 64 x 64 pictures of these halves, mean and max 0.9514.
    const FlipError error = *ldr_flip(grey(64, 64, 0.89990234f), grey(64, 64, 0.099975586f));
    CHECK(error.mean == Approx(0.9514).margin(5e-5));
    CHECK(error.max == Approx(0.9514).margin(5e-5));
}

TEST_CASE("pictures agree with the two-dimensional filters of the paper", "[cpu]") {
    struct Case {
        ImageF test, reference;
        double distance;
    };
    const Case cases[] = {{noise(23, 17, 3, 1, 0, 1), noise(23, 17, 3, 2, 0, 1), ppd},
                          {noise(4, 31, 3, 3, 0, 1), noise(4, 31, 3, 4, 0, 0.2), 30},
                          {dot(25, 21, 4, 12), grey(25, 21, 0.2f), ppd},
                          {dot(9, 9, 0, 0), dot(9, 9, 8, 8), 150},
                          {uniform(7, 6, 1, 0, 0), noise(7, 6, 3, 5, 0, 1), 12},
                          {noise(1, 1, 3, 6, 0, 1), noise(1, 1, 3, 7, 0, 1), ppd}};
    for (const Case& c : cases) {
        const Image<double> direct = flip_direct::error_map(doubled(c.test), doubled(c.reference), c.distance);
        const FlipError error = *ldr_flip(c.test, c.reference, {.pixels_per_degree = c.distance});
        double sum = 0, worst = 0;
        for (std::size_t i = 0; i < direct.data.size(); ++i) {
            sum += direct.data[i];
            worst = std::max(worst, std::abs(direct.data[i] - static_cast<double>(error.map.data[i])));
        }
        // Where features are equal, rounding of 1e-16 is 1e-8 in their square root; the map is float.
        CHECK(worst < 2e-7);
        CHECK(error.mean == Approx(sum / static_cast<double>(direct.data.size())).margin(2e-7));
    }
}

TEST_CASE("the metric is symmetric, also in its axes", "[cpu]") {
    const ImageF a = noise(29, 14, 3, 1, 0, 1), b = noise(29, 14, 3, 2, 0, 1);
    const FlipError ab = *ldr_flip(a, b), ba = *ldr_flip(b, a);
    CHECK(ab.map.data == ba.map.data);
    CHECK(ab.mean == ba.mean);
    const ImageF turned = (*ldr_flip(transposed(a), transposed(b))).map, map = transposed(ab.map);
    for (std::size_t i = 0; i < map.data.size(); ++i) REQUIRE(turned.data[i] == Approx(map.data[i]).margin(1e-6));
}

TEST_CASE("errors are in [0,1], whatever comes", "[cpu]") {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        ImageF a = noise(19, 16, 3, seed, 0, 1), b = noise(19, 16, 3, seed + 100, 0, 1);
        if (seed % 2)  // only 0 and 1: the strongest edges there are
            for (ImageF* image : {&a, &b})
                for (float& v : image->data) v = v < 0.5f ? 0.0f : 1.0f;
        if (seed % 4 == 0)
            for (float& v : a.data) v = std::exp2((v - 0.5f) * 400.0f);
        for (const double distance : {1.0, 20.0, ppd}) {
            const FlipError error = *ldr_flip(a, b, {.pixels_per_degree = distance});
            for (const float e : error.map.data) REQUIRE((e >= 0 && e <= 1));
            REQUIRE((error.min <= error.mean && error.mean <= error.max));
            REQUIRE(error.mean > 0);
        }
    }
}

TEST_CASE("a larger offset is a larger error", "[cpu]") {
    double last = 0;
    for (int i = 1; i <= 40; ++i) {
        const double now = mean(grey(3, 3, 0.2f + 0.02f * static_cast<float>(i)), grey(3, 3, 0.2f));
        REQUIRE(now > last);
        last = now;
    }
}

TEST_CASE("errors move with what makes them", "[cpu]") {
    // Far enough from every border: the filters reach 10 pixels.
    const FlipError here = *ldr_flip(dot(60, 50, 25, 22), grey(60, 50, 0.2f));
    const FlipError there = *ldr_flip(dot(60, 50, 31, 27), grey(60, 50, 0.2f));
    CHECK(here.max > 0.1);
    for (std::uint32_t y = 0; y < 45; ++y)
        for (std::uint32_t x = 0; x < 54; ++x) REQUIRE(*here.map.texel(x, y) == *there.map.texel(x + 6, y + 5));
    CHECK(*here.map.texel(25, 22) > 0);
    CHECK(*here.map.texel(25, 33) == 0);  // 11 rows away: out of reach
    CHECK(*here.map.texel(36, 22) == 0);
}

TEST_CASE("seen from farther away a dot is less", "[cpu]") {
    double last = 1;
    for (const double distance : {10.0, 20.0, 40.0, 80.0}) {
        const double now = (*ldr_flip(dot(41, 41, 20, 20), grey(41, 41, 0.2f), {.pixels_per_degree = distance})).max;
        CHECK(now < last);
        last = now;
    }
}

TEST_CASE("what a display cannot show makes no difference, and subnormal light is none", "[cpu]") {
    CHECK(mean(grey(4, 4, 1e4f), grey(4, 4, 1)) == 0);
    CHECK(mean(grey(4, 4, -3), grey(4, 4, 0)) == 0);
    CHECK(mean(grey(4, 4, std::numeric_limits<float>::denorm_min()), grey(4, 4, 0)) < 1e-20);
}

TEST_CASE("a pixel that is not finite is wrong, and black for its neighbours", "[cpu]") {
    const ImageF reference = noise(25, 15, 3, 1, 0, 1), clean = noise(25, 15, 3, 2, 0, 1);
    for (const float bad : {not_a_number, infinity, -infinity}) {
        ImageF test = clean, black_test = clean, black_reference = reference;
        test.texel(12, 7)[2] = bad;
        std::fill_n(black_test.texel(12, 7), 3, 0.0f);
        std::fill_n(black_reference.texel(12, 7), 3, 0.0f);
        const FlipError error = *ldr_flip(test, reference), expected = *ldr_flip(black_test, black_reference);
        CHECK(error.nonfinite == 1);
        CHECK(error.pixels == 25 * 15);
        CHECK(error.max == 1);
        for (std::size_t i = 0; i < error.map.data.size(); ++i)
            REQUIRE(error.map.data[i] == (i == 7 * 25 + 12 ? 1.0f : expected.map.data[i]));
        CHECK((*ldr_flip(reference, test)).mean == error.mean);
        CHECK((*ldr_flip(test, test)).mean == Approx(1.0 / (25 * 15)).epsilon(1e-12));  // not finite on both sides
    }
    const FlipError all = *ldr_flip(grey(2, 2, not_a_number), grey(2, 2, not_a_number));
    CHECK(all.mean == 1);
    CHECK(all.nonfinite == 4);
}

TEST_CASE("a mask pools, and its absence of pixels is not a zero", "[cpu]") {
    const ImageF reference = grey(20, 4, 0.2f);
    ImageF test = reference;
    test.texel(0, 0)[0] = not_a_number;
    std::fill_n(test.texel(19, 3), 3, 1.0f);
    Image8 mask(20, 4, 1);
    std::fill(mask.data.begin(), mask.data.end(), std::uint8_t{254});
    const FlipError none = *ldr_flip(test, reference, {.mask = &mask});
    CHECK(none.pixels == 0);
    CHECK(none.masked_out == 80);
    CHECK(none.nonfinite == 0);
    for (const double number : {none.mean, none.min, none.max, none.weighted_lower_quartile, none.weighted_median,
                                none.weighted_upper_quartile})
        CHECK(std::isnan(number));
    CHECK(none.map.data[0] == 1);  // the map has every pixel
    *mask.texel(19, 2) = 255;
    const FlipError one = *ldr_flip(test, reference, {.mask = &mask});
    CHECK(one.pixels == 1);
    CHECK(one.mean > 0);  // a neighbour of the white pixel sees it
    CHECK(static_cast<float>(one.mean) == *one.map.texel(19, 2));
    const FlipError empty = *ldr_flip(ImageF(0, 0, 3), ImageF(0, 0, 3));
    CHECK(empty.pixels == 0);
    CHECK(std::isnan(empty.mean));
}

TEST_CASE("weighted quartiles", "[cpu]") {
    // Four stripes so broad that their middles are uniform, masked to these: errors 0, a, b, c.
    ImageF reference = grey(160, 1, 0.2f), test = reference;
    const float values[] = {0.2f, 0.25f, 0.4f, 0.9f};
    for (std::uint32_t x = 0; x < 160; ++x) std::fill_n(test.texel(x, 0), 3, values[x / 40]);
    Image8 mask(160, 1, 1);
    for (std::uint32_t x = 20; x < 160; x += 40) mask.data[x] = 255;
    const FlipError error = *ldr_flip(test, reference, {.mask = &mask});
    CHECK(error.pixels == 4);
    std::vector<double> e;
    for (const float value : values) e.push_back(uniform_error({value, value, value}, {0.2f, 0.2f, 0.2f}));
    CHECK(error.min == Approx(0).margin(1e-12));
    CHECK(error.max == Approx(e[3]).margin(2e-7));
    const double sum = e[1] + e[2] + e[3];
    CHECK(error.mean == Approx(sum / 4).margin(2e-7));
    const auto expected = [&](double q) { return e[1] > q * sum ? e[1] : e[1] + e[2] > q * sum ? e[2] : e[3]; };
    CHECK(error.weighted_lower_quartile == Approx(expected(0.25)).margin(2e-7));
    CHECK(error.weighted_median == Approx(expected(0.5)).margin(2e-7));
    CHECK(error.weighted_upper_quartile == Approx(expected(0.75)).margin(2e-7));
    CHECK(error.weighted_lower_quartile < error.weighted_upper_quartile);
}

TEST_CASE("a weighted quartile is passed, not reached", "[cpu]") {
    const std::vector<double> errors = {0, 0.25, 0.25, 0.5};  // add up to 0, 0.25, 0.5, 1
    CHECK(detail::weighted_quantile(errors, 1, 0.25) == 0.25);
    CHECK(detail::weighted_quantile(errors, 1, 0.5) == 0.5);
    CHECK(detail::weighted_quantile(errors, 1, 0.49) == 0.25);
    CHECK(detail::weighted_quantile(errors, 1, 0.1) == 0.25);
    CHECK(detail::weighted_quantile({0, 0}, 0, 0.5) == 0);
}

TEST_CASE("grey is RGB of equal channels, and alpha is not seen", "[cpu]") {
    const ImageF a = noise(15, 8, 1, 1, 0, 1), b = noise(15, 8, 1, 2, 0, 1);
    ImageF a4(15, 8, 4), b4(15, 8, 4);
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) a4.data[4 * i + c] = a.data[i], b4.data[4 * i + c] = b.data[i];
        a4.data[4 * i + 3] = not_a_number;
    }
    CHECK((*ldr_flip(a, b)).map.data == (*ldr_flip(a4, b4)).map.data);
}

TEST_CASE("what FLIP does not take is named", "[cpu]") {
    const ImageF picture(3, 2, 3);
    const auto message = [&](const Result<FlipError>& result) {
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        return result.error().message;
    };
    CHECK(message(ldr_flip(picture, ImageF(2, 3, 3))).find("LDR-FLIP: the test picture is [2, 3, 3]") == 0);
    CHECK(message(ldr_flip(ImageF(3, 2, 2), ImageF(3, 2, 2))).find("3 (RGB)") != std::string::npos);
    for (const double bad : {0.0, -67.0, 0.99, 1001.0, double(infinity), double(not_a_number)})
        CHECK(message(ldr_flip(picture, picture, {.pixels_per_degree = bad})).find("[1, 1000]") != std::string::npos);
    const Image8 mask(3, 3, 1);
    CHECK(message(ldr_flip(picture, picture, {.mask = &mask})).find("mask") != std::string::npos);
}

TEST_CASE("FLIP as JSON", "[cpu]") {
    CHECK(to_json(*ldr_flip(grey(2, 1, 1), grey(2, 1, 1))) ==
          "{\"pixels\": 2, \"masked_out\": 0, \"nonfinite\": 0, \"mean\": 0, \"min\": 0, \"max\": 0, "
          "\"weighted_lower_quartile\": 0, \"weighted_median\": 0, \"weighted_upper_quartile\": 0}");
    CHECK(to_json(*ldr_flip(ImageF(0, 0, 3), ImageF(0, 0, 3))).find("\"mean\": null") != std::string::npos);
}
