// SPDX-License-Identifier: MIT
#include <pellucid/passes/strip_bands.hpp>
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;

namespace {
std::vector<gpu::LayerStrip> strips(std::initializer_list<std::uint32_t> slots) {
    std::vector<gpu::LayerStrip> out;
    for (const std::uint32_t n : slots) out.push_back({.slots = n});
    return out;
}
using Bands = std::vector<StripBand>;
}  // namespace

TEST_CASE("strips are united as long as they fit, and none is lost", "[cpu]") {
    const auto all = strips({0, 3, 4, 0, 5, 1, 0});
    CHECK(test::must(split_strips(all, 100, 16)) == Bands{{.first = 1, .count = 5, .slots = 13}});
    CHECK(test::must(split_strips(all, 7, 16)) ==
          Bands{{.first = 1, .count = 2, .slots = 7}, {.first = 4, .count = 2, .slots = 6}});
    CHECK(test::must(split_strips(all, 5, 16)) == Bands{{.first = 1, .count = 1, .slots = 3},
                                                        {.first = 2, .count = 1, .slots = 4},
                                                        {.first = 4, .count = 1, .slots = 5},
                                                        {.first = 5, .count = 1, .slots = 1}});
    CHECK(test::must(split_strips(strips({0, 0}), 0, 16)).empty());
    CHECK(test::must(split_strips({}, 0, 16)).empty());
}

TEST_CASE("a strip that does not fit is refused by the one that takes most: raising the budget once is enough",
          "[cpu]") {
    const auto all = strips({3, 4, 9, 5});
    const auto refused = split_strips(all, 3, 16);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::invalid_argument);
    CHECK(refused.error().message ==
          "the translucent fragments of rows 16 to 23 of the picture alone take 144 bytes, and the memory budget has "
          "room for 48 bytes of fragments: raise it to at least that");
    CHECK(split_strips(all, 144 / 16, 16));
    CHECK_FALSE(split_strips(all, 144 / 16 - 1, 16));
}
