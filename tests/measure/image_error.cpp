// SPDX-License-Identifier: MIT
#include <limits>
#include <pellucid/measure/image_error.hpp>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;

namespace {
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

template <class T>
Image<T> image(std::uint32_t width, std::uint32_t height, std::uint32_t channels, std::vector<T> data) {
    Image<T> result(width, height, channels);
    REQUIRE(result.data.size() == data.size());
    result.data = std::move(data);
    return result;
}
}  // namespace

TEST_CASE("errors have their hand-computed values", "[cpu]") {
    const ImageF reference = image<float>(2, 1, 3, {0, 1, 2, 4, 0, 8});
    const ImageF test = image<float>(2, 1, 3, {0.5f, 1, 2, 2, 0, 9});
    const ImageError e = *image_error(test, reference);  // errors 0.5, 0, 0, 2, 0, 1
    CHECK(e.pixels == 2);
    CHECK(e.values == 6);
    CHECK(e.mean == Approx(3.5 / 6).epsilon(1e-14));
    CHECK(e.rmse == Approx(std::sqrt(5.25 / 6)).epsilon(1e-14));
    CHECK(e.max == 2);
    CHECK(e.p999 == 2);
    CHECK(e.worst.x == 1);
    CHECK(e.worst.y == 0);
    CHECK(e.worst.channel == 0);
    CHECK(e.worst.value == 2);
    CHECK(e.worst.reference == 4);
    CHECK(e.relative_mse == Approx((0.25 / 0.01 + 4 / 16.01 + 1 / 64.01) / 6).epsilon(1e-12));
    CHECK(e.different_pixels == 2);
    CHECK(e.different_values == 3);
    CHECK(e.within(2));
    CHECK_FALSE(e.within(1.999));
    CHECK_FALSE(e.bit_equal());

    const ImageError s = *image_error(test, reference, {.scale = ErrorScale::scaled});  // 0.5, 0, 0, 0.5, 0, 0.125
    CHECK(s.max == 0.5);
    CHECK(s.worst.x == 0);  // the first of two
    CHECK(s.mean == Approx(1.125 / 6).epsilon(1e-14));
    CHECK(s.relative_mse == e.relative_mse);
}

TEST_CASE("p99.9 is the 999th of 1000 errors", "[cpu]") {
    ImageF test(500, 2, 1), reference(500, 2, 1);
    for (std::size_t i = 0; i < 1000; ++i) test.data[(i * 387) % 1000] = static_cast<float>(i + 1);
    const ImageError e = *image_error(test, reference);
    CHECK(e.p999 == 999);
    CHECK(e.max == 1000);
}

TEST_CASE("equal pictures have no error, and one bit is found", "[cpu]") {
    const ImageF reference = image<float>(1, 2, 4, {0, -1, 2.5f, 1, 1e-30f, 7, 65504, 0.1f});
    ImageF test = reference;
    const ImageError equal = *image_error(test, reference);
    CHECK(equal.bit_equal());
    CHECK(equal.max == 0);
    CHECK(equal.different_pixels == 0);
    CHECK(equal.within(0));
    test.data[7] = std::nextafter(0.1f, 1.0f);
    const ImageError one = *image_error(test, reference);
    CHECK(one.max_ulp == 1);
    CHECK(one.different_pixels == 1);
    CHECK(one.different_values == 1);
    CHECK(one.different_bits >= 1);
    CHECK(one.worst.y == 1);
    CHECK(one.worst.channel == 3);
    test = reference;
    test.data[0] = -0.0f;  // another bit, the same number
    const ImageError zero = *image_error(test, reference);
    CHECK(zero.different_bits == 1);
    CHECK(zero.max_ulp == 0);
    CHECK(zero.max == 0);
}

TEST_CASE("ulp distances cross zero and exponents", "[cpu]") {
    CHECK(ulp_distance(1.0f, 1.0f) == 0);
    CHECK(ulp_distance(1.0f, std::nextafter(1.0f, 2.0f)) == 1);
    CHECK(ulp_distance(2.0f, std::nextafter(2.0f, 0.0f)) == 1);
    CHECK(ulp_distance(0.0f, -0.0f) == 0);
    const float least = std::numeric_limits<float>::denorm_min();
    CHECK(ulp_distance(least, -least) == 2);
    CHECK(ulp_distance(1.0f, 2.0f) == 1u << 23u);
    CHECK(ulp_distance(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()) == 0xFEFFFFFEu);
}

TEST_CASE("values that are not finite are counted, kept out of the sums, and never pass", "[cpu]") {
    const ImageF reference = image<float>(1, 2, 3, {1, 1, 1, 1, infinity, 1});
    const ImageF test = image<float>(1, 2, 3, {1.5f, not_a_number, 1, 1, infinity, -infinity});
    const ImageError e = *image_error(test, reference);
    CHECK(e.nonfinite == 3);
    CHECK(e.nonfinite_reference == 1);
    CHECK(e.values == 3);
    CHECK(e.max == 0.5);
    CHECK(e.mean == Approx(0.5 / 3).epsilon(1e-14));
    CHECK_FALSE(e.within(1e30));
    const ImageError none = *image_error(image<float>(1, 1, 1, {not_a_number}), image<float>(1, 1, 1, {1}));
    CHECK(none.values == 0);
    CHECK(none.max == 0);
    CHECK_FALSE(none.within(1));
}

TEST_CASE("a mask leaves pixels out and says how many", "[cpu]") {
    const ImageF reference(3, 1, 3);
    const ImageF test = image<float>(3, 1, 3, {1, 1, 1, not_a_number, 5, 5, 0, 0, 0});
    const Image8 mask = image<std::uint8_t>(3, 1, 1, {255, 254, 255});
    const ImageError e = *image_error(test, reference, {.mask = &mask});
    CHECK(e.pixels == 2);
    CHECK(e.masked_out == 1);
    CHECK(e.max == 1);
    CHECK(e.nonfinite == 0);
    CHECK(e.different_pixels == 1);
    const Image8 nothing(3, 1, 1);
    CHECK_FALSE((*image_error(test, reference, {.mask = &nothing})).within(1e30));
}

TEST_CASE("shapes that do not match are named", "[cpu]") {
    const Result<ImageError> shapes = image_error(ImageF(2, 3, 3), ImageF(2, 3, 4));
    REQUIRE_FALSE(shapes);
    CHECK(shapes.error().code == Errc::invalid_argument);
    CHECK(shapes.error().message.find("[3, 2, 3]") != std::string::npos);
    CHECK(shapes.error().message.find("[3, 2, 4]") != std::string::npos);
    const Image8 mask(2, 2, 1);
    CHECK_FALSE(image_error(ImageF(2, 3, 3), ImageF(2, 3, 3), {.mask = &mask}));
    CHECK_FALSE(error_picture(ImageF(2, 3, 3), ImageF(3, 3, 3)));
    CHECK_FALSE(image_error(Image8(1, 1, 5), Image8(1, 1, 5)));
}

TEST_CASE("PSNR of 8-bit pictures", "[cpu]") {
    const Image8 reference = image<std::uint8_t>(2, 1, 3, {0, 10, 20, 255, 255, 255});
    const Image8 test = image<std::uint8_t>(2, 1, 3, {0, 13, 16, 255, 255, 255});
    const Image8Error e = *image_error(test, reference);
    CHECK(e.mse == Approx(25.0 / 6).epsilon(1e-14));
    CHECK(e.psnr == Approx(10 * std::log10(65025 * 6 / 25.0)).epsilon(1e-12));
    CHECK(e.max == 4);
    CHECK(e.different_pixels == 1);
    CHECK(std::isinf((*image_error(reference, reference)).psnr));
    const Image8 black(1, 1, 1), white = image<std::uint8_t>(1, 1, 1, {255});
    CHECK((*image_error(black, white)).psnr == Approx(0).margin(1e-12));
    const Image8 mask = image<std::uint8_t>(2, 1, 1, {0, 255});
    CHECK((*image_error(test, reference, &mask)).max == 0);
    CHECK((*image_error(test, reference, &mask)).masked_out == 1);
}

TEST_CASE("the error picture holds the worst channel", "[cpu]") {
    const ImageF reference = image<float>(3, 1, 3, {0, 0, 0, 4, 4, 4, 0, 0, 0});
    const ImageF test = image<float>(3, 1, 3, {1, 0.5f, 0, 4, 2, 4, 0, not_a_number, 0});
    const ImageF absolute = *error_picture(test, reference);
    CHECK(absolute.channels == 1);
    CHECK(absolute.data[0] == 1);
    CHECK(absolute.data[1] == 2);
    CHECK(std::isnan(absolute.data[2]));
    CHECK((*error_picture(test, reference, {.scale = ErrorScale::scaled})).data[1] == 0.5f);
    const Image8 mask = image<std::uint8_t>(3, 1, 1, {0, 255, 255});
    CHECK(std::isnan((*error_picture(test, reference, {.mask = &mask})).data[0]));
}

TEST_CASE("errors become JSON without infinities", "[cpu]") {
    const ImageF reference(1, 1, 3);
    const ImageF test = image<float>(1, 1, 3, {0.25f, 0, 0});
    CHECK(to_json(*image_error(test, reference)) ==
          "{\"scale\": \"absolute\", \"pixels\": 1, \"masked_out\": 0, \"values\": 3, \"mean\": "
          "0.08333333333333333, \"rmse\": 0.14433756729740643, \"max\": 0.25, \"p999\": 0.25, \"relative_mse\": "
          "2.0833333333333335, \"worst\": {\"x\": 0, \"y\": 0, \"channel\": 0, \"value\": 0.25, \"reference\": 0}, "
          "\"nonfinite\": 0, \"nonfinite_reference\": 0, \"different_pixels\": 1, \"different_values\": 1, "
          "\"different_bits\": 6, \"max_ulp\": 1048576000}");
    CHECK(to_json(*image_error(Image8(1, 1, 3), Image8(1, 1, 3))) ==
          "{\"pixels\": 1, \"masked_out\": 0, \"different_pixels\": 0, \"max\": 0, \"mse\": 0, \"psnr\": null}");
}
