// SPDX-License-Identifier: MIT
#include <pellucid/measure/hdr_flip.hpp>
#include <pellucid/measure/flip_color.hpp>
#include "measure/flip_direct.hpp"
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
/// Light over many stops.
ImageF bright(std::uint32_t width, std::uint32_t height, unsigned seed) {
    ImageF image = noise(width, height, 3, seed, -6, 5);
    for (float& value : image.data) value = std::exp2(value);
    return image;
}
Image<double> doubled(const ImageF& image, double scale = 1) {
    Image<double> result(image.width, image.height, image.channels);
    for (std::size_t i = 0; i < image.data.size(); ++i) result.data[i] = scale * static_cast<double>(image.data[i]);
    return result;
}
flip::ExposureRange range(const ImageF& reference) {
    return flip::exposure_range(doubled(reference));
}
}  // namespace

TEST_CASE("the curve and its brightest shown light", "[cpu]") {
    CHECK(flip::aces(0) == 0);
    CHECK(flip::aces(1e30) == 1);
    for (const double x : {1e-3, 0.1, 1.0, 2.0, 30.0})
        CHECK(flip::aces(x) == Approx(flip_direct::aces(x)).epsilon(1e-13));
    CHECK(flip::aces(flip::brightest_shown()) == Approx(0.85).epsilon(1e-14));
    CHECK(flip::brightest_shown() == Approx(2.1188723).epsilon(1e-7));
    double last = -1;
    for (int i = 0; i < 300; ++i) {
        REQUIRE(flip::aces(i * 0.02) > last);
        last = flip::aces(i * 0.02);
    }
}

TEST_CASE("exposures follow the reference", "[cpu]") {
    // Printed by OpenImageIO, testsuite/flip/ref/out.txt, for a maximum of 2 and a median of 0.18: [0.0833, 3.56].
    ImageF reference = grey(3, 1, 0.18f);
    std::fill_n(reference.texel(1, 0), 3, 2.0f);
    flip::ExposureRange exposures = range(reference);
    CHECK(exposures.start == Approx(0.0833).margin(5e-5));
    CHECK(exposures.stop == Approx(3.56).margin(5e-3));
    CHECK(flip::exposure_count(exposures) == 4);
    // The same file: a uniform picture of the half 0.1.
    exposures = range(grey(64, 64, 0.099975586f));
    CHECK(exposures.start == Approx(4.41).margin(5e-3));
    CHECK(exposures.start == exposures.stop);
    CHECK(flip::exposure_count(exposures) == 2);
    // Printed by the authors' tool for their test pictures (NVlabs/flip, README): 14 exposures.
    CHECK(flip::exposure_count({-12.5423, 0.9427}) == 14);
    CHECK(flip::exposure_count({-12.5, 1.11}) == 14);
    CHECK(flip::exposure_count({-2, 1}) == 3);
}

TEST_CASE("luminance weighs the channels, and the median is the upper one", "[cpu]") {
    ImageF reference(4, 1, 3);
    reference.data = {0, 1, 0, 0, 0, 1, 1, 0, 0, 0.5f, 0.5f, 0.5f};  // 0.7152, 0.0722, 0.2126, 0.5
    const flip::ExposureRange exposures = range(reference);
    CHECK(exposures.start == Approx(std::log2(flip::brightest_shown() / 0.7152)).epsilon(1e-14));
    CHECK(exposures.stop == Approx(std::log2(flip::brightest_shown() / 0.5)).epsilon(1e-14));
}

TEST_CASE("dark references", "[cpu]") {
    const flip::ExposureRange black = range(grey(5, 5, 0));
    CHECK(black.start == 0);
    CHECK(black.stop == 0);
    CHECK(range(ImageF(0, 0, 3)).stop == 0);
    ImageF lit = grey(5, 1, 0);  // black for more than its half: the median of the lit pixels
    std::fill_n(lit.texel(0, 0), 3, 4.0f);
    std::fill_n(lit.texel(1, 0), 3, 0.25f);
    CHECK(range(lit).start == Approx(std::log2(flip::brightest_shown() / 4)).epsilon(1e-14));
    CHECK(range(lit).stop == Approx(std::log2(flip::brightest_shown() / 4)).epsilon(1e-14));
    std::fill_n(lit.texel(2, 0), 3, 0.125f);  // lit for more than its half: the median of all
    CHECK(range(lit).stop == Approx(std::log2(flip::brightest_shown() / 0.125)).epsilon(1e-14));
    // Subnormal light ends at 2^-23.
    const flip::ExposureRange faint = range(grey(2, 2, std::numeric_limits<float>::denorm_min()));
    CHECK(faint.stop == Approx(std::log2(flip::brightest_shown()) + 23).epsilon(1e-14));
    CHECK(faint.start == faint.stop);
}

TEST_CASE("a published value: uniform pictures of 0.1 and 0.9", "[cpu]") {
    const HdrFlipError result = *hdr_flip(grey(64, 64, 0.89990234f), grey(64, 64, 0.099975586f));
    CHECK(result.exposures == 2);
    // By hand: the reference is shown as 0.85, the other as white; L* of 0.85 is 116 · 0.85^(1/3) − 16.
    const double lightness = 100 - (116 * std::cbrt(0.85) - 16);
    CHECK(result.error.mean == Approx(flip::color_error(lightness)).margin(2e-7));
    // OpenImageIO, testsuite/flip/ref/out.txt, prints 0.2045.  It computes in single precision, where the weights of a
    // detector add up to about 1e-7 in place of 0; q_f makes an exponent of 1 − 2.5e-4 of that, and 0.20443 becomes
    // 0.20451 (repeated with binary32 arithmetic).
    const double features = 2.503972865232835e-4;
    CHECK(std::pow(result.error.mean, 1 - features) == Approx(0.2045).margin(5e-5));
}

TEST_CASE("the largest of the two-dimensional filters' errors over the exposures", "[cpu]") {
    const ImageF reference = bright(17, 12, 1), test = bright(17, 12, 2);
    const double ppd = 40;
    const HdrFlipError result = *hdr_flip(test, reference, {.pixels_per_degree = ppd});
    CHECK(result.exposures == std::max(2.0, std::ceil(result.stop_exposure - result.start_exposure)));
    REQUIRE(result.exposures > 3);
    std::vector<double> largest(17 * 12), exposure(17 * 12);
    for (std::uint32_t n = 0; n < result.exposures; ++n) {
        const double stops = result.start_exposure + (result.stop_exposure - result.start_exposure) * n /
                                                         (static_cast<double>(result.exposures) - 1);
        Image<double> a = doubled(test, std::pow(2, stops)), b = doubled(reference, std::pow(2, stops));
        for (Image<double>* image : {&a, &b})
            for (double& value : image->data) value = flip_direct::aces(value);
        const Image<double> errors = flip_direct::error_map(a, b, ppd);
        for (std::size_t i = 0; i < largest.size(); ++i)
            if (errors.data[i] > largest[i]) {
                largest[i] = errors.data[i];
                exposure[i] = stops;
            }
    }
    double sum = 0;
    for (std::size_t i = 0; i < largest.size(); ++i) {
        REQUIRE(result.error.map.data[i] == Approx(largest[i]).margin(2e-7));
        REQUIRE(result.exposure.data[i] == Approx(exposure[i]).margin(1e-6));
        sum += largest[i];
    }
    CHECK(result.error.mean == Approx(sum / static_cast<double>(largest.size())).margin(2e-7));
}

TEST_CASE("more light for both pictures is only another exposure", "[cpu]") {
    const ImageF reference = bright(15, 11, 1);
    ImageF test = reference;
    for (std::size_t i = 0; i < test.data.size(); i += 5) test.data[i] *= 1.5f;
    ImageF reference8 = reference, test8 = test;
    for (float& value : reference8.data) value *= 256;
    for (float& value : test8.data) value *= 256;
    const HdrFlipError one = *hdr_flip(test, reference), two = *hdr_flip(test8, reference8);
    CHECK(two.start_exposure == Approx(one.start_exposure - 8).epsilon(1e-13));
    CHECK(two.stop_exposure == Approx(one.stop_exposure - 8).epsilon(1e-13));
    CHECK(two.error.mean == Approx(one.error.mean).epsilon(1e-6));
    CHECK(one.error.mean > 0);
}

TEST_CASE("errors of the dark and of the bright are both found, at their exposures", "[cpu]") {
    ImageF reference = grey(80, 3, 0.002f);
    for (std::uint32_t y = 0; y < 3; ++y)
        for (std::uint32_t x = 50; x < 80; ++x) std::fill_n(reference.texel(x, y), 3, 500.0f);
    ImageF test = reference;
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 10; ++x) std::fill_n(test.texel(x, y), 3, 0.003f);
        for (std::uint32_t x = 70; x < 80; ++x) std::fill_n(test.texel(x, y), 3, 700.0f);
    }
    const HdrFlipError result = *hdr_flip(test, reference);
    CHECK(*result.error.map.texel(0, 1) > 0.05f);
    CHECK(*result.error.map.texel(79, 1) > 0.05f);
    CHECK(*result.exposure.texel(0, 1) > 5);
    CHECK(*result.exposure.texel(79, 1) < -5);
    CHECK(*result.error.map.texel(40, 1) == 0);
    CHECK(*result.exposure.texel(40, 1) == static_cast<float>(result.start_exposure));
    CHECK(*(*ldr_flip(test, reference)).map.texel(79, 1) == 0);  // a display at exposure 1 hides it
}

TEST_CASE("equal pictures have no error at any exposure", "[cpu]") {
    for (const ImageF& picture : {bright(9, 7, 1), grey(1, 1, 0), grey(2, 2, 1e4f), grey(3, 1, 3e38f)}) {
        const HdrFlipError result = *hdr_flip(picture, picture);
        CHECK(result.error.max == 0);
        CHECK(result.exposures >= 2);
    }
}

TEST_CASE("light that no half holds is the largest, and negative light is none", "[cpu]") {
    CHECK((*hdr_flip(grey(2, 2, 3e38f), grey(2, 2, 65536))).error.max == 0);
    CHECK((*hdr_flip(grey(2, 2, -1), grey(2, 2, 0))).error.max == 0);
    const HdrFlipError huge = *hdr_flip(grey(2, 2, 1), grey(2, 2, 3e38f));
    CHECK(huge.start_exposure == Approx(std::log2(flip::brightest_shown()) - 16).epsilon(1e-13));
    CHECK(huge.error.mean > 0.9);
}

TEST_CASE("an all black reference is shown as it is", "[cpu]") {
    const HdrFlipError result = *hdr_flip(grey(3, 3, 1), grey(3, 3, 0));
    CHECK(result.start_exposure == 0);
    CHECK(result.stop_exposure == 0);
    CHECK(result.exposures == 2);
    const double shown = flip_direct::aces(1);
    CHECK(result.error.mean == Approx(flip_direct::color_error({shown, shown, shown}, {0, 0, 0})).margin(2e-7));
}

TEST_CASE("pixels that are not finite have the largest error and no say in exposures", "[cpu]") {
    ImageF reference = grey(31, 25, 0.5f), test = reference;
    reference.texel(15, 12)[0] = infinity;
    test.texel(0, 0)[1] = not_a_number;
    const HdrFlipError result = *hdr_flip(test, reference);
    CHECK(result.error.nonfinite == 2);
    CHECK(*result.error.map.texel(15, 12) == 1);
    CHECK(*result.error.map.texel(0, 0) == 1);
    CHECK(result.error.mean == Approx(2.0 / (31 * 25)).epsilon(1e-12));
    CHECK(result.stop_exposure == Approx(std::log2(flip::brightest_shown() / 0.5)).epsilon(1e-14));
    const HdrFlipError all = *hdr_flip(grey(2, 2, not_a_number), grey(2, 2, 1));
    CHECK(all.error.mean == 1);
    CHECK(all.start_exposure == 0);
}

TEST_CASE("given exposures are used, and sizes below filters work", "[cpu]") {
    const HdrFlipError result =
        *hdr_flip(grey(1, 1, 0.5f), grey(1, 1, 1), {.start_exposure = -1, .stop_exposure = 2, .exposures = 7});
    CHECK(result.exposures == 7);
    CHECK(result.start_exposure == -1);
    CHECK(result.stop_exposure == 2);
    double largest = 0;
    for (int n = 0; n < 7; ++n) {
        const double scale = std::pow(2, -1 + 0.5 * n), a = flip_direct::aces(0.5 * scale),
                     b = flip_direct::aces(scale);
        largest = std::max(largest, flip_direct::color_error({a, a, a}, {b, b, b}));
    }
    CHECK(result.error.mean == Approx(largest).margin(2e-7));
    const HdrFlipError stop_only = *hdr_flip(grey(1, 1, 0.5f), grey(1, 1, 1), {.stop_exposure = 4});
    CHECK(stop_only.start_exposure == Approx(std::log2(flip::brightest_shown())).epsilon(1e-14));
    CHECK(stop_only.exposures == 3);
}

TEST_CASE("what HDR-FLIP does not take is named", "[cpu]") {
    const ImageF picture = grey(3, 2, 1);
    const auto message = [&](const HdrFlipOptions& options) {
        const Result<HdrFlipError> result = hdr_flip(picture, picture, options);
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        return result.error().message;
    };
    CHECK(message({.start_exposure = 3, .stop_exposure = 2}).find("from 3.000000 to 2.000000") != std::string::npos);
    CHECK(message({.start_exposure = 20}).find("must rise") != std::string::npos);
    CHECK(message({.start_exposure = -101}).find("[-100, 100]") != std::string::npos);
    CHECK(message({.stop_exposure = infinity}).find("[-100, 100]") != std::string::npos);
    CHECK(message({.exposures = 1}).find("2 ... 256") != std::string::npos);
    CHECK(message({.exposures = 257}).find("257") != std::string::npos);
    CHECK(message({.pixels_per_degree = 0}).find("HDR-FLIP") == 0);
    CHECK_FALSE(hdr_flip(picture, grey(2, 3, 1)));
    CHECK_FALSE(hdr_flip(ImageF(2, 2, 2), ImageF(2, 2, 2)));
}

TEST_CASE("a mask pools HDR-FLIP too", "[cpu]") {
    Image8 mask(3, 2, 1);
    const HdrFlipError none = *hdr_flip(grey(3, 2, 0.5f), grey(3, 2, 1), {.mask = &mask});
    CHECK(std::isnan(none.error.mean));
    CHECK(none.error.masked_out == 6);
    CHECK(none.stop_exposure == Approx(std::log2(flip::brightest_shown())).epsilon(1e-14));
    CHECK(none.error.map.data[0] > 0);
}

TEST_CASE("HDR-FLIP as JSON", "[cpu]") {
    CHECK(to_json(*hdr_flip(grey(1, 1, 0), grey(1, 1, 0))) ==
          "{\"error\": {\"pixels\": 1, \"masked_out\": 0, \"nonfinite\": 0, \"mean\": 0, \"min\": 0, \"max\": 0, "
          "\"weighted_lower_quartile\": 0, \"weighted_median\": 0, \"weighted_upper_quartile\": 0}, "
          "\"start_exposure\": 0, \"stop_exposure\": 0, \"exposures\": 2}");
}
