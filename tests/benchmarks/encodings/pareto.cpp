// SPDX-License-Identifier: MIT
#include "encodings/pareto.hpp"
#include "support/catch.hpp"

using namespace pellucid::bench;

TEST_CASE("the Pareto front holds what nothing beats", "[cpu]") {
    using Flags = std::vector<bool>;
    CHECK(pareto_front({}).empty());
    CHECK(pareto_front({{1, 1, ""}}) == Flags{true});
    CHECK(pareto_front({{1, 3, ""}, {2, 2, ""}, {3, 1, ""}, {3, 3, ""}}) == Flags{true, true, true, false});
    CHECK(pareto_front({{1, 2, ""}, {1, 1, ""}, {2, 1, ""}}) == Flags{false, true, false});  // as cheap, and as close
    CHECK(pareto_front({{1, 1, ""}, {1, 1, ""}}) == Flags{true, true});
    CHECK(pareto_front({{0, NAN, ""}, {1, INFINITY, ""}, {2, 1, ""}}) == Flags{false, false, true});
}

TEST_CASE("a plot's front runs from left to right, and the rest is grey", "[cpu]") {
    const Plot plot = pareto_plot("t", "x", "y", {{3, 1, "c"}, {3, 3, "beaten"}, {1, 3, "a"}, {2, 2, "b"}});
    REQUIRE(plot.series.size() == 2);
    REQUIRE(plot.series[0].points.size() == 3);
    CHECK(plot.series[0].connected);
    CHECK(plot.series[0].points[0].label == "a");
    CHECK(plot.series[0].points[1].label == "b");
    CHECK(plot.series[0].points[2].label == "c");
    REQUIRE(plot.series[1].points.size() == 1);
    CHECK(plot.series[1].guest);
    CHECK(plot.series[1].points[0].label == "beaten");
    CHECK(pareto_plot("t", "x", "y", {{1, 1, "a"}}).series.size() == 1);
}
