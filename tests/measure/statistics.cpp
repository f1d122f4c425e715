// SPDX-License-Identifier: MIT
#include <numeric>
#include <pellucid/measure/statistics.hpp>
#include "support/catch.hpp"

using namespace pellucid::measure;

TEST_CASE("median and quartiles interpolate between order statistics", "[cpu]") {
    const Summary odd = summarize({5, 1, 3});
    CHECK(odd.median == 3);
    CHECK(odd.lower_quartile == 2);
    CHECK(odd.upper_quartile == 4);
    CHECK(odd.spread() == 2);
    CHECK(odd.mean == 3);
    CHECK(odd.min == 1);
    CHECK(odd.max == 5);
    CHECK(odd.count == 3);
    CHECK(median({4, 1, 3, 2}) == 2.5);
    const Summary even = summarize({4, 1, 3, 2});
    CHECK(even.lower_quartile == 1.75);
    CHECK(even.upper_quartile == 3.25);
    CHECK(median({7}) == 7);
    CHECK(summarize({7}).spread() == 0);
    CHECK(summarize({}).count == 0);
    CHECK(median({}) == 0);
}

TEST_CASE("the nearest rank is always one of the values", "[cpu]") {
    std::vector<double> thousand(1000);
    std::iota(thousand.rbegin(), thousand.rend(), 1.0);  // 1000, 999, … 1
    CHECK(nearest_rank(thousand, 0.999) == 999);
    CHECK(nearest_rank(thousand, 1.0) == 1000);
    CHECK(nearest_rank(thousand, 0.0) == 1);
    CHECK(nearest_rank(thousand, 0.9991) == 1000);
    CHECK(nearest_rank(thousand, 0.5) == 500);
    std::vector<double> hundred(100);
    std::iota(hundred.begin(), hundred.end(), 1.0);
    CHECK(nearest_rank(hundred, 0.07) == 7);  // 0.07 · 100 rounds to just above 7
    std::vector<double> few = {3, 1, 2};
    CHECK(nearest_rank(few, 0.999) == 3);
    CHECK(nearest_rank(few, 0.5) == 2);
    CHECK(nearest_rank(few, 1.0 / 3) == 1);
    CHECK(nearest_rank({}, 0.5) == 0);
}
