// SPDX-License-Identifier: MIT
#include <pellucid/measure/ssim.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
constexpr double c1 = 1e-4, c2 = 9e-4;
/// Luminance term alone (equation 6 of the paper).
double luminance(double a, double b) {
    return (2 * a * b + c1) / (a * a + b * b + c1);
}
int code(unsigned x, unsigned y) {
    return static_cast<int>((7 * x * x + 13 * x * y + 5 * y) % 256);
}
double mean(const ImageF& a, const ImageF& b) {
    return (*ssim(a, b)).mean;
}
}  // namespace

TEST_CASE("a picture is structurally equal to itself, whatever it is", "[cpu]") {
    for (const ImageF& picture : {noise(13, 12, 3, 1, -1, 2), grey(11, 11, 0), grey(11, 30, 1e4f),
                                  grey(12, 11, std::numeric_limits<float>::denorm_min())}) {
        const SsimResult result = *ssim(picture, picture);
        CHECK(result.mean == 1);
        CHECK(result.windows == (picture.width - 10) * (picture.height - 10));
        CHECK(result.nonfinite == 0);
    }
}

TEST_CASE("uniform pictures differ by the luminance term alone", "[cpu]") {
    for (const double a : {0.0, 0.25, 0.5, 1.0})
        for (const double b : {0.0, 0.1, 0.9, 1.0}) {
            const double got = mean(grey(11, 11, shown_as(a)), grey(11, 11, shown_as(b)));
            REQUIRE(got == Approx(luminance(a, b)).epsilon(1e-6));
        }
    CHECK(mean(grey(11, 11, 0), grey(11, 11, 1)) == Approx(c1 / (1 + c1)).epsilon(1e-12));
}

TEST_CASE("an offset leaves contrast and structure alone", "[cpu]") {
    const auto wave = [](unsigned x, unsigned y) { return 0.4 + 0.2 * std::sin(0.9 * x + 0.5 * y); };
    const ImageF a = shown(20, 14, wave);
    const ImageF b = shown(20, 14, [&](unsigned x, unsigned y) { return wave(x, y) + 0.15; });
    const SsimResult result = *ssim(b, a);
    for (std::uint32_t y = 5; y < 9; ++y)
        for (std::uint32_t x = 5; x < 15; ++x) {
            // The window's mean of the wave, from its definition.
            double sum = 0, weights = 0;
            for (int j = -5; j <= 5; ++j)
                for (int i = -5; i <= 5; ++i) {
                    const double w = std::exp(-(i * i + j * j) / 4.5);
                    weights += w;
                    sum += w * wave(x + static_cast<unsigned>(i), y + static_cast<unsigned>(j));
                }
            REQUIRE(*result.map.texel(x, y) == Approx(luminance(sum / weights, sum / weights + 0.15)).epsilon(2e-6));
        }
}

TEST_CASE("one white pixel in a window, by hand", "[cpu]") {
    ImageF dot(11, 11, 1);
    *dot.texel(5, 5) = 1;
    double row = 0;
    for (int i = -5; i <= 5; ++i) row += std::exp(-i * i / 4.5);
    const double w = 1 / (row * row);  // the centre's weight: the mean of the dot, and of its square
    const double expected = c1 * c2 / ((w * w + c1) * (w - w * w + c2));
    const SsimResult result = *ssim(dot, ImageF(11, 11, 1));
    CHECK(result.windows == 1);
    CHECK(result.mean == Approx(expected).epsilon(1e-12));
    CHECK(*result.map.texel(5, 5) == static_cast<float>(expected));
    ImageF corner(11, 11, 1);
    *corner.texel(0, 0) = 1;  // weighs exp(−50/4.5) as much: hardly seen
    CHECK(mean(corner, ImageF(11, 11, 1)) > 0.99);
}

TEST_CASE("inverted contrast is negative", "[cpu]") {
    const ImageF a = shown(16, 16, [](unsigned x, unsigned y) { return (x + y) % 2 ? 1.0 : 0.0; });
    const ImageF b = shown(16, 16, [](unsigned x, unsigned y) { return (x + y) % 2 ? 0.0 : 1.0; });
    CHECK(mean(a, b) < -0.99);
    CHECK(mean(a, b) > -1);
    CHECK(mean(a, b) == mean(b, a));
}

TEST_CASE("values of another implementation", "[cpu]") {
    // Computed with ssim.js 3.5.0 (npm), function originalSsim: a port of the authors' ssim_index.m; scikit-image
    // 0.19.3 gives 0.9500835040390332 for the first.
    const ImageF a = shown(24, 20, [](unsigned x, unsigned y) { return code(x, y) / 255.0; });
    const ImageF b = shown(24, 20, [](unsigned x, unsigned y) {
        return (code(x, y) * 3 / 4 + 20 + static_cast<int>(x * y % 31)) / 255.0;
    });
    const ImageF c =
        shown(24, 20, [](unsigned x, unsigned y) { return (code(x, y) + (y < 10 ? 0 : 64)) % 256 / 255.0; });
    const SsimResult ab = *ssim(b, a), ac = *ssim(c, a);
    CHECK(ab.windows == 14 * 10);
    CHECK(ab.mean == Approx(0.950083504039033).epsilon(1e-6));
    CHECK(*ab.map.texel(5, 5) == Approx(0.9484755970707845).epsilon(1e-6));
    CHECK(*ab.map.texel(18, 14) == Approx(0.9455217236144007).epsilon(1e-6));
    CHECK(ac.mean == Approx(0.44983709138153977).epsilon(1e-6));
    CHECK(*ac.map.texel(5, 5) == Approx(0.999259159092352).epsilon(1e-6));
    CHECK(*ac.map.texel(18, 14) == Approx(-0.17392288485365895).epsilon(1e-5));
}

TEST_CASE("a border of five pixels has no window", "[cpu]") {
    const SsimResult result = *ssim(noise(14, 12, 1, 1, 0, 1), noise(14, 12, 1, 2, 0, 1));
    CHECK(result.map.channels == 1);
    std::uint64_t windows = 0;
    for (std::uint32_t y = 0; y < 12; ++y)
        for (std::uint32_t x = 0; x < 14; ++x) {
            const bool full = x >= 5 && x <= 8 && y >= 5 && y <= 6;
            REQUIRE(std::isnan(*result.map.texel(x, y)) == !full);
            windows += full;
        }
    CHECK(result.windows == windows);
}

TEST_CASE("a window with a pixel that is not finite is the worst", "[cpu]") {
    const ImageF reference = grey(31, 21, 0.5f);
    ImageF test = reference;
    test.texel(15, 10)[1] = not_a_number;
    const SsimResult result = *ssim(test, reference);
    CHECK(result.windows == 21 * 11);
    CHECK(result.nonfinite == 11 * 11);
    CHECK(result.mean == Approx((21 * 11 - 2 * 121) / (21.0 * 11)).epsilon(1e-12));
    CHECK(*result.map.texel(10, 5) == -1);
    CHECK(*result.map.texel(9, 5) == 1);
    CHECK((*ssim(reference, test)).mean == result.mean);
    CHECK((*ssim(test, test)).nonfinite == 121);
    ImageF bright = reference;
    bright.texel(15, 10)[0] = infinity;
    CHECK((*ssim(bright, reference)).nonfinite == 121);
}

TEST_CASE("a mask picks windows by their centres", "[cpu]") {
    const ImageF reference = grey(12, 11, 0.5f);
    ImageF test = reference;
    test.texel(0, 0)[0] = 1;
    Image8 mask(12, 11, 1);
    CHECK(std::isnan((*ssim(test, reference, &mask)).mean));
    CHECK((*ssim(test, reference, &mask)).windows == 0);
    *mask.texel(0, 0) = 255;  // no window is centred there
    CHECK((*ssim(test, reference, &mask)).windows == 0);
    *mask.texel(6, 5) = 255;
    const SsimResult right = *ssim(test, reference, &mask);
    CHECK(right.windows == 1);
    CHECK(right.mean == 1);  // columns 1 … 11: the changed pixel is not in it
    *mask.texel(6, 5) = 0;
    *mask.texel(5, 5) = 255;
    CHECK((*ssim(test, reference, &mask)).mean < 1);
    CHECK_FALSE(std::isnan(*right.map.texel(5, 5)));  // the map ignores the mask
}

TEST_CASE("pictures smaller than a window are refused with the size in the sentence", "[cpu]") {
    for (const ImageF& small : {ImageF(10, 11, 3), ImageF(11, 10, 3), ImageF(1, 1, 3), ImageF(0, 0, 3)}) {
        const Result<SsimResult> result = ssim(small, small);
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        CHECK(result.error().message.find("[" + std::to_string(small.height)) != std::string::npos);
        CHECK(result.error().message.find("11 pixels") != std::string::npos);
    }
    CHECK_FALSE(ssim(ImageF(11, 11, 3), ImageF(12, 11, 3)));
    CHECK_FALSE(ssim(ImageF(11, 11, 2), ImageF(11, 11, 2)));
    const Image8 mask(11, 12, 1);
    CHECK_FALSE(ssim(ImageF(11, 11, 3), ImageF(11, 11, 3), &mask));
}

TEST_CASE("grey, RGB and alpha", "[cpu]") {
    const ImageF a = noise(15, 13, 1, 1, 0, 1), b = noise(15, 13, 1, 2, 0, 1);
    ImageF a4(15, 13, 4), b4(15, 13, 4);
    for (std::size_t i = 0; i < a.data.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) a4.data[4 * i + c] = a.data[i], b4.data[4 * i + c] = b.data[i];
        a4.data[4 * i + 3] = not_a_number;
    }
    CHECK(mean(a4, b4) == mean(a, b));
}

TEST_CASE("SSIM as JSON", "[cpu]") {
    CHECK(to_json(*ssim(grey(11, 11, 1), grey(11, 11, 1))) == "{\"windows\": 1, \"nonfinite\": 0, \"mean\": 1}");
    const Image8 nothing(11, 11, 1);
    CHECK(to_json(*ssim(grey(11, 11, 1), grey(11, 11, 1), &nothing)) ==
          "{\"windows\": 0, \"nonfinite\": 0, \"mean\": null}");
}
