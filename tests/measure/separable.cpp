// SPDX-License-Identifier: MIT
#include <pellucid/measure/detail/separable.hpp>
#include "support/catch.hpp"

using namespace pellucid::measure::detail;

namespace {
Plane plane(std::uint32_t width, std::uint32_t height, std::vector<double> data) {
    Plane result(width, height, 1);
    REQUIRE(result.data.size() == data.size());
    result.data = std::move(data);
    return result;
}
const std::vector<double> kernel = {1, 10, 100};  // digits show where a value went
}  // namespace

TEST_CASE("weights lie over the pixels, not mirrored, and the border repeats", "[cpu]") {
    CHECK(filter_rows(plane(3, 1, {1, 2, 3}), kernel).data == std::vector<double>{211, 321, 332});
    CHECK(filter_columns(plane(1, 3, {1, 2, 3}), kernel).data == std::vector<double>{211, 321, 332});
    CHECK(filter_rows(plane(2, 2, {1, 2, 3, 4}), kernel).data == std::vector<double>{211, 221, 433, 443});
    CHECK(filter_columns(plane(2, 2, {1, 2, 3, 4}), kernel).data == std::vector<double>{311, 422, 331, 442});
}

TEST_CASE("pictures smaller than a kernel, and none at all", "[cpu]") {
    CHECK(filter_rows(plane(1, 1, {2}), kernel).data == std::vector<double>{222});
    CHECK(filter_columns(plane(1, 1, {2}), kernel).data == std::vector<double>{222});
    const std::vector<double> wide = {1, 1, 1, 1, 1, 1, 1};
    CHECK(filter_rows(plane(2, 1, {1, 10}), wide).data == std::vector<double>{34, 43});
    CHECK(filter_columns(plane(1, 2, {1, 10}), wide).data == std::vector<double>{34, 43});
    CHECK(filter_rows(Plane(0, 0, 1), kernel).empty());
    CHECK(filter_columns(Plane(0, 0, 1), kernel).empty());
    CHECK(filter_rows(plane(2, 1, {3, 4}), std::vector<double>{2}).data == std::vector<double>{6, 8});
}
