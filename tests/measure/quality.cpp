// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <pellucid/measure/quality.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}
}  // namespace

TEST_CASE("a report holds what each metric says on its own", "[cpu]") {
    const ImageF reference = noise(21, 17, 3, 1, 0, 4), test = noise(21, 17, 3, 2, 0, 4);
    Image8 mask(21, 17, 1);
    for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = i % 3 ? 255 : 0;
    const QualityReport report = *quality(test, reference, {.mask = &mask, .pixels_per_degree = 33});
    CHECK(report.width == 21);
    CHECK(report.height == 17);
    CHECK(report.channels == 3);
    CHECK(to_json(report.absolute.value()) == to_json(*image_error(test, reference, {.mask = &mask})));
    CHECK(to_json(report.scaled.value()) ==
          to_json(*image_error(test, reference, {.scale = ErrorScale::scaled, .mask = &mask})));
    CHECK(report.tone_mapped_psnr.value().psnr == (*tone_mapped_psnr(test, reference, &mask)).psnr);
    CHECK(report.ssim.value().mean == (*ssim(test, reference, &mask)).mean);
    const FlipError ldr = *ldr_flip(test, reference, {.pixels_per_degree = 33, .mask = &mask});
    CHECK(report.ldr_flip.value().mean == ldr.mean);
    CHECK(report.ldr_flip.value().map.data == ldr.map.data);
    const HdrFlipError hdr = *hdr_flip(test, reference, {.pixels_per_degree = 33, .mask = &mask});
    CHECK(report.hdr_flip.value().error.mean == hdr.error.mean);
    CHECK(to_json(report.coverage.value()) == to_json(*coverage_error(test, reference, mask, ErrorScale::scaled)));
    CHECK_FALSE(report.layers);
    CHECK(report.notes.empty());
}

TEST_CASE("only what is asked for is measured", "[cpu]") {
    const ImageF picture = grey(12, 12, 0.5f);
    const QualityReport few =
        *quality(picture, picture, {.metrics = QualityMetrics::ssim | QualityMetrics::tone_mapped_psnr});
    CHECK(few.ssim);
    CHECK(few.tone_mapped_psnr);
    CHECK_FALSE(few.absolute);
    CHECK_FALSE(few.scaled);
    CHECK_FALSE(few.ldr_flip);
    CHECK_FALSE(few.hdr_flip);
    CHECK_FALSE(few.coverage);
    const QualityReport all = *quality(picture, picture);
    CHECK(all.absolute);
    CHECK(all.scaled);
    CHECK(all.ldr_flip);
    CHECK(all.hdr_flip);
    CHECK_FALSE(all.coverage);  // there is no mask
    const Image8 mask(12, 12, 1);
    CHECK_FALSE((*quality(picture, picture, {.metrics = QualityMetrics::errors, .mask = &mask})).coverage);
}

TEST_CASE("layer counts make coverage; a mask adds to it", "[cpu]") {
    const ImageF reference = grey(2, 2, 0.5f);
    ImageF test = reference;
    test.texel(1, 0)[0] = 3.5f;
    LayerCounts a(2, 2, 1), b(2, 2, 1);
    a.data = {1, 2, 1, 0};
    b.data = {1, 1, 1, 0};
    QualityReport report = *quality(test, reference, {.test_layers = &a, .reference_layers = &b});
    CHECK(report.layers.value().different == 1);
    CHECK(report.coverage.value().unstable_pixels == 1);
    CHECK(report.coverage.value().unstable.max == 3);
    CHECK(report.coverage.value().stable.max == 0);
    CHECK(report.absolute.value().pixels == 4);  // layers leave no pixel out of the other metrics
    Image8 mask(2, 2, 1);
    mask.data = {0, 255, 255, 255};
    report = *quality(test, reference, {.mask = &mask, .test_layers = &a, .reference_layers = &b});
    CHECK(report.coverage.value().unstable_pixels == 2);
    CHECK(report.absolute.value().pixels == 3);
    CHECK(report.absolute.value().masked_out == 1);
}

TEST_CASE("the smallest pictures have a report without SSIM, and are told so", "[cpu]") {
    for (const Extent2D size : {Extent2D{1, 1}, {10, 30}, {11, 1}, {0, 0}}) {
        const ImageF picture(size.width, size.height, 3);
        const QualityReport report = *quality(picture, picture);
        CHECK_FALSE(report.ssim);
        REQUIRE(report.notes.size() == 1);
        CHECK(contains(report.notes[0], "SSIM: the pictures are ["));
        CHECK(contains(to_text(report), "left out: SSIM"));
        const auto json = nlohmann::json::parse(to_json(report));
        CHECK(json["ssim"].is_null());
        CHECK(json["notes"][0].get<std::string>() == report.notes[0]);
        CHECK(json["ldr_flip"]["mean"].is_null() == (size.width == 0));
    }
}

TEST_CASE("bad values are in every metric and in the text", "[cpu]") {
    const ImageF reference = grey(13, 12, 0.5f);
    ImageF test = reference;
    test.texel(6, 6)[0] = not_a_number;
    test.texel(0, 0)[1] = infinity;
    const QualityReport report = *quality(test, reference);
    CHECK(report.absolute.value().nonfinite == 2);
    CHECK_FALSE(report.absolute.value().within(1));
    CHECK(report.tone_mapped_psnr.value().nonfinite == 2);
    CHECK(report.ssim.value().nonfinite == 3 * 2);
    CHECK(report.ldr_flip.value().nonfinite == 2);
    CHECK(report.hdr_flip.value().error.nonfinite == 2);
    CHECK(contains(to_text(report), "NOT FINITE: 2 values (reference: 0)"));
    CHECK(nlohmann::json::parse(to_json(report))["absolute"]["nonfinite"] == 2);
    const QualityReport all = *quality(grey(11, 11, not_a_number), grey(11, 11, not_a_number));
    CHECK(all.ldr_flip.value().mean == 1);
    CHECK(all.ssim.value().mean == -1);
    CHECK(all.tone_mapped_psnr.value().psnr == 0);
    CHECK(all.absolute.value().values == 0);
}

TEST_CASE("a mask that leaves nothing gives nulls, not perfect scores", "[cpu]") {
    const ImageF picture = grey(12, 12, 0.5f);
    const Image8 mask(12, 12, 1);
    const QualityReport report = *quality(picture, picture, {.mask = &mask});
    const auto json = nlohmann::json::parse(to_json(report));
    CHECK(json["tone_mapped_psnr"]["psnr"].is_null());
    CHECK(json["ssim"]["mean"].is_null());
    CHECK(json["ldr_flip"]["mean"].is_null());
    CHECK(json["hdr_flip"]["error"]["mean"].is_null());
    CHECK(json["absolute"]["values"] == 0);
    CHECK(json["coverage"]["unstable_pixels"] == 144);
    CHECK(contains(to_text(report), "0 compared, 144 left out"));
    CHECK_FALSE(contains(to_text(report), "equal"));
}

TEST_CASE("extremes have reports", "[cpu]") {
    const float least = std::numeric_limits<float>::denorm_min(), most = std::numeric_limits<float>::max();
    const float values[] = {0, least, 1e4f, most, -most};
    for (const float a : values)
        for (const float b : values) {
            const QualityReport report = *quality(grey(11, 11, a), grey(11, 11, b));
            for (const double number : {report.ssim.value().mean, report.ldr_flip.value().mean,
                                        report.hdr_flip.value().error.mean, report.tone_mapped_psnr.value().mse}) {
                REQUIRE(std::isfinite(number));
                REQUIRE((number >= 0 && number <= 1));
            }
            REQUIRE(report.hdr_flip.value().exposures <= 40);
            REQUIRE_NOTHROW(nlohmann::json::parse(to_json(report)));
        }
}

TEST_CASE("the text is one paragraph with the numbers", "[cpu]") {
    const ImageF reference = grey(12, 11, 1);
    ImageF test = reference;
    test.texel(3, 2)[1] = 1.5f;
    Image8 mask(12, 11, 1);
    std::fill(mask.data.begin(), mask.data.end(), std::uint8_t{255});
    mask.data[0] = 0;
    char hdr[16];
    std::snprintf(hdr, sizeof hdr, "%.4f", (*hdr_flip(test, reference, {.mask = &mask})).error.mean);
    CHECK(to_text(*quality(test, reference, {.mask = &mask})) ==
          "12 x 11 pixels, 131 compared, 1 left out: RMSE 0.02522, maximum 0.5 at (3, 2), scaled RMSE 0.02522 and "
          "maximum 0.5; PSNR inf dB; SSIM 1.00000; LDR-FLIP 0.0000; HDR-FLIP " +
              std::string(hdr) +
              " over 2 exposures from +1.08 to +1.08 stops; 1 of 132 pixels are unstable, with scaled RMSE 0 and "
              "maximum 0 there (elsewhere 0.02522 and 0.5).");
    const std::string equal = to_text(*quality(reference, reference));
    CHECK(contains(equal, "bit for bit equal"));
    CHECK(contains(equal, "HDR-FLIP 0.0000"));
    CHECK_FALSE(contains(equal, "\n"));
}

TEST_CASE("reports name what they cannot be made of", "[cpu]") {
    const ImageF picture(3, 2, 3);
    const LayerCounts layers(3, 2, 1), wrong(2, 2, 1);
    const Image8 mask(2, 3, 1);
    const auto message = [&](const ImageF& reference, const QualityOptions& options) {
        const Result<QualityReport> result = quality(picture, reference, options);
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        return result.error().message;
    };
    CHECK(contains(message(ImageF(3, 2, 4), {}), "quality: the test picture is [2, 3, 3]"));
    CHECK(contains(message(picture, {.mask = &mask}), "the mask is [3, 2, 1]"));
    CHECK(contains(message(picture, {.test_layers = &layers}), "only the test"));
    CHECK(contains(message(picture, {.reference_layers = &layers}), "only the reference"));
    CHECK(
        contains(message(picture, {.test_layers = &wrong, .reference_layers = &wrong}), "layer counts are [2, 2, 1]"));
    CHECK(contains(message(picture, {.test_layers = &layers, .reference_layers = &wrong}), "layer difference"));
    CHECK(contains(message(picture, {.pixels_per_degree = 0}), "pixels_per_degree is 0"));
    CHECK_FALSE(quality(ImageF(1, 1, 2), ImageF(1, 1, 2)));
}
