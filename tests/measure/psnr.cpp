// SPDX-License-Identifier: MIT
#include <pellucid/measure/psnr.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

TEST_CASE("a known step of the display signal has its PSNR", "[cpu]") {
    // Half the signal everywhere: mse 0.25.
    const ImageF white = grey(4, 3, 1), half = grey(4, 3, shown_as(0.5));
    CHECK((*tone_mapped_psnr(half, white)).psnr == Approx(10 * std::log10(4.0)).epsilon(1e-6));
    CHECK((*tone_mapped_psnr(half, white)).psnr == (*tone_mapped_psnr(white, half)).psnr);
    // One channel of one pixel of two: mse 1/6.
    const ImageF black = grey(2, 1, 0);
    ImageF one = black;
    one.data[4] = 1;
    const ToneMappedPsnr result = *tone_mapped_psnr(one, black);
    CHECK(result.mse == Approx(1.0 / 6).epsilon(1e-14));
    CHECK(result.psnr == Approx(10 * std::log10(6.0)).epsilon(1e-14));
    CHECK((*tone_mapped_psnr(grey(1, 1, 1), grey(1, 1, 0))).psnr == 0);
}

TEST_CASE("what a display cannot show makes no difference", "[cpu]") {
    CHECK(std::isinf((*tone_mapped_psnr(grey(3, 3, 1e4f), grey(3, 3, 1))).psnr));
    CHECK(std::isinf((*tone_mapped_psnr(grey(3, 3, -5), grey(3, 3, 0))).psnr));
    CHECK((*tone_mapped_psnr(grey(3, 3, 1e4f), grey(3, 3, 1))).psnr > 0);
    const float least = std::numeric_limits<float>::denorm_min();
    CHECK((*tone_mapped_psnr(grey(3, 3, least), grey(3, 3, 0))).psnr > 800);  // 20 log10(1 / (12.92 · 1.4e-45))
}

TEST_CASE("a value that is not finite has the error of black against white", "[cpu]") {
    ImageF test = grey(2, 2, 0.5f), reference = test;
    test.data[3] = not_a_number;
    reference.data[4] = infinity;
    const ToneMappedPsnr result = *tone_mapped_psnr(test, reference);
    CHECK(result.nonfinite == 2);
    CHECK(result.mse == Approx(2.0 / 12).epsilon(1e-14));
    test = reference;  // not finite on both sides: still bad
    CHECK((*tone_mapped_psnr(test, reference)).nonfinite == 1);
    CHECK((*tone_mapped_psnr(test, reference)).mse == Approx(1.0 / 12).epsilon(1e-14));
}

TEST_CASE("alpha and masked pixels are not compared", "[cpu]") {
    ImageF test(2, 1, 4), reference(2, 1, 4);
    test.data = {0, 0, 0, 0.7f, 1, 1, 1, not_a_number};
    Image8 mask(2, 1, 1);
    CHECK((*tone_mapped_psnr(test, reference)).mse == 0.5);
    mask.data = {255, 0};
    const ToneMappedPsnr left = *tone_mapped_psnr(test, reference, &mask);
    CHECK(left.pixels == 1);
    CHECK(left.masked_out == 1);
    CHECK(left.nonfinite == 0);
    CHECK(std::isinf(left.psnr));
    mask.data = {254, 0};
    const ToneMappedPsnr none = *tone_mapped_psnr(test, reference, &mask);
    CHECK(none.pixels == 0);
    CHECK(std::isnan(none.psnr));
    CHECK(std::isnan((*tone_mapped_psnr(ImageF(0, 0, 3), ImageF(0, 0, 3))).psnr));
}

TEST_CASE("PSNR names shapes that do not match", "[cpu]") {
    const Result<ToneMappedPsnr> result = tone_mapped_psnr(ImageF(2, 3, 3), ImageF(2, 3, 4));
    REQUIRE_FALSE(result);
    CHECK(result.error().message.find("tone-mapped PSNR: the test picture is [3, 2, 3]") == 0);
    CHECK(tone_mapped_psnr(ImageF(2, 3, 2), ImageF(2, 3, 2)).error().message.find("[3, 2, 2]") != std::string::npos);
    const Image8 mask(2, 2, 1);
    CHECK_FALSE(tone_mapped_psnr(ImageF(2, 3, 3), ImageF(2, 3, 3), &mask));
}

TEST_CASE("PSNR as JSON", "[cpu]") {
    CHECK(to_json(*tone_mapped_psnr(grey(1, 1, 1), grey(1, 1, 0))) ==
          "{\"pixels\": 1, \"masked_out\": 0, \"nonfinite\": 0, \"mse\": 1, \"psnr\": 0}");
    CHECK(to_json(*tone_mapped_psnr(grey(1, 1, 1), grey(1, 1, 1))).find("\"psnr\": null") != std::string::npos);
}
