// SPDX-License-Identifier: MIT
#include <pellucid/measure/order_variance.hpp>
#include "measure/pictures.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::measure;
using namespace pictures;

namespace {
ImageF row(std::vector<float> values) {
    ImageF image(static_cast<std::uint32_t>(values.size()), 1, 1);
    image.data = std::move(values);
    return image;
}
OrderVariance variance(const std::vector<ImageF>& pictures) {
    return *order_variance(pictures);
}
}  // namespace

TEST_CASE("equal orders have no variance", "[cpu]") {
    const ImageF picture = noise(5, 4, 4, 1, -10, 10);
    const OrderVariance result = variance({picture, picture, picture});
    CHECK(result.orders == 3);
    CHECK(result.pixels == 20);
    CHECK(result.bit_equal());
    CHECK(result.different_orders == 0);
    CHECK(result.different_pixels == 0);
    CHECK(result.max_difference == 0);
    CHECK(result.max_ulp == 0);
    CHECK(result.max_bits == 0);
}

TEST_CASE("the spread is between any two orders, not from the baseline", "[cpu]") {
    const OrderVariance result = variance({row({1, 4}), row({1.5f, 4}), row({0.25f, 4})});
    CHECK(result.max_difference == 1.25);
    CHECK(result.worst.value == 1.5f);
    CHECK(result.worst.reference == 0.25f);
    CHECK(result.max_ulp == ulp_distance(1.5f, 0.25f));
    CHECK(result.different_orders == 2);
    CHECK(result.different_pixels == 1);
    CHECK(result.different_values == 1);
    CHECK_FALSE(result.bit_equal());
}

TEST_CASE("the largest difference and the largest ulp distance may be of different values", "[cpu]") {
    const float least = std::numeric_limits<float>::denorm_min();
    ImageF a(3, 2, 3), b(3, 2, 3);
    a.texel(1, 1)[2] = 1e4f;
    b.texel(1, 1)[2] = std::nextafter(1e4f, 2e4f);
    b.texel(2, 0)[0] = 100 * least;
    const OrderVariance result = variance({a, b});
    CHECK(result.max_difference == static_cast<double>(std::nextafter(1e4f, 2e4f)) - 1e4);
    CHECK(result.worst.x == 1);
    CHECK(result.worst.y == 1);
    CHECK(result.worst.channel == 2);
    CHECK(result.max_ulp == 100);
    CHECK(result.different_pixels == 2);
    CHECK(result.different_values == 2);
}

TEST_CASE("signs of zero are bits and no difference", "[cpu]") {
    const OrderVariance result = variance({row({0.0f}), row({-0.0f})});
    CHECK(result.different_values == 1);
    CHECK(result.max_bits == 1);
    CHECK(result.max_difference == 0);
    CHECK(result.max_ulp == 0);
    CHECK_FALSE(result.bit_equal());
}

TEST_CASE("values that are not finite are counted and kept out of spreads", "[cpu]") {
    const OrderVariance result =
        variance({row({1, not_a_number, infinity, 2}), row({not_a_number, not_a_number, infinity, 2.5f})});
    CHECK(result.nonfinite == 3);
    CHECK(result.max_difference == 0.5);
    CHECK(result.different_values == 2);  // two NaNs of the same bits are alike
    CHECK(result.different_pixels == 2);
    const OrderVariance signs = variance({row({infinity}), row({-infinity})});
    CHECK(signs.max_difference == 0);
    CHECK(signs.max_bits == 1);
    CHECK_FALSE(signs.bit_equal());
}

TEST_CASE("the whole range of floats fits", "[cpu]") {
    const float most = std::numeric_limits<float>::max();
    const OrderVariance result = variance({row({most}), row({-most})});
    CHECK(result.max_difference == 2 * static_cast<double>(most));
    CHECK(result.max_ulp == 0xFEFFFFFEu);
}

TEST_CASE("too few orders and unlike shapes are named", "[cpu]") {
    const auto message = [](std::vector<ImageF> pictures) {
        const Result<OrderVariance> result = order_variance(pictures);
        REQUIRE_FALSE(result);
        CHECK(result.error().code == Errc::invalid_argument);
        return result.error().message;
    };
    CHECK(message({}).find("0 pictures") != std::string::npos);
    CHECK(message({row({1})}).find("1 pictures") != std::string::npos);
    CHECK(message({row({1}), row({1}), row({1, 2})}).find("order 2 against the baseline") != std::string::npos);
    CHECK(message({ImageF(1, 1, 5), ImageF(1, 1, 5)}).find("[1, 1, 5]") != std::string::npos);
    CHECK(variance({ImageF(0, 0, 3), ImageF(0, 0, 3)}).pixels == 0);
}

TEST_CASE("order variance as JSON", "[cpu]") {
    CHECK(to_json(variance({row({1}), row({1.5f})})) ==
          "{\"orders\": 2, \"pixels\": 1, \"different_orders\": 1, \"different_pixels\": 1, \"different_values\": 1, "
          "\"nonfinite\": 0, \"max_difference\": 0.5, \"max_ulp\": 4194304, \"max_bits\": 1, \"worst\": {\"x\": 0, "
          "\"y\": 0, \"channel\": 0, \"value\": 1.5, \"reference\": 1}}");
}
