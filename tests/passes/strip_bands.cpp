// SPDX-License-Identifier: MIT
// How strips of fragments are gathered into bands that fit.
#include <numeric>
#include <pellucid/passes/strip_bands.hpp>
#include <random>
#include "support/catch.hpp"
#include "support/devices.hpp"

using namespace pellucid;

namespace {
std::vector<gpu::LayerStrip> strips(std::initializer_list<std::uint32_t> slots) {
    std::vector<gpu::LayerStrip> out;
    for (const std::uint32_t s : slots) out.push_back({.slots = s});
    return out;
}
using Bands = std::vector<StripBand>;
}  // namespace

TEST_CASE("strips without fragments make no band", "[cpu]") {
    CHECK(test::must(split_strips({}, 100, 16)).empty());
    CHECK(test::must(split_strips(strips({0}), 100, 16)).empty());
    CHECK(test::must(split_strips(strips({0, 0, 0}), 0, 16)).empty());
}

TEST_CASE("what fits is one band, to the last place", "[cpu]") {
    CHECK(test::must(split_strips(strips({7}), 7, 16)) == Bands{{0, 1, 7}});
    CHECK(test::must(split_strips(strips({3, 4}), 7, 16)) == Bands{{0, 2, 7}});
    CHECK(test::must(split_strips(strips({3, 5}), 7, 16)) == Bands{{0, 1, 3}, {1, 1, 5}});
    CHECK(test::must(split_strips(strips({4, 4, 4, 4}), 8, 16)) == Bands{{0, 2, 8}, {2, 2, 8}});
    CHECK(test::must(split_strips(strips({1, 1, 1}), 1, 16)) == Bands{{0, 1, 1}, {1, 1, 1}, {2, 1, 1}});
}

TEST_CASE("empty strips at the ends of a band belong to none, those inside to it", "[cpu]") {
    CHECK(test::must(split_strips(strips({0, 0, 3, 0, 4, 0}), 7, 16)) == Bands{{2, 3, 7}});
    CHECK(test::must(split_strips(strips({0, 3, 0, 0, 5, 0, 2, 0}), 7, 16)) == Bands{{1, 1, 3}, {4, 3, 7}});
}

TEST_CASE("a strip that is too large by one place is an error with both numbers", "[cpu]") {
    const auto refused = split_strips(strips({1, 8, 1}), 7, 16);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == Errc::invalid_argument);
    const std::string& message = refused.error().message;
    INFO(message);
    CHECK(message.find("rows 8 to 15") != std::string::npos);
    CHECK(message.find(std::to_string(8 * 16) + " bytes") != std::string::npos);
    CHECK(message.find(std::to_string(7 * 16) + " bytes") != std::string::npos);
    REQUIRE_FALSE(split_strips(strips({1}), 0, 16));
}

TEST_CASE("places are counted beyond 32 bits", "[cpu]") {
    const std::uint32_t most = ~0u;
    // Two strips of almost 2^32 places do not fit together into 2^32: their sum must not wrap.
    CHECK(test::must(split_strips(strips({most, most}), std::uint64_t{1} << 32, 16)).size() == 2);
    const auto refused = split_strips(strips({most}), most - 1, 16);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find(std::to_string(std::uint64_t{most} * 16)) != std::string::npos);
}

TEST_CASE("any strips: bands are in order, hold everything, fit, and none could take one strip more", "[cpu]") {
    std::mt19937 random(7);
    for (int round = 0; round < 500; ++round) {
        std::vector<gpu::LayerStrip> all(1 + random() % 40);
        std::uint32_t largest = 1;
        for (gpu::LayerStrip& s : all) {
            s.slots = random() % 3 == 0 ? 0 : static_cast<std::uint32_t>(random() % 100);
            largest = std::max(largest, s.slots);
        }
        const std::uint32_t capacity = largest + static_cast<std::uint32_t>(random() % 200);
        const Bands bands = test::must(split_strips(all, capacity, 16));
        std::uint32_t end = 0;
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const StripBand& band = bands[b];
            for (; end < band.first; ++end) REQUIRE(all[end].slots == 0);
            std::uint32_t sum = 0;
            for (; end < band.first + band.count; ++end) sum += all[end].slots;
            REQUIRE(sum == band.slots);
            REQUIRE(sum <= capacity);
            REQUIRE(all[band.first].slots > 0);
            REQUIRE(all[end - 1].slots > 0);
            if (b > 0) REQUIRE(bands[b - 1].slots + all[band.first].slots > capacity);
        }
        for (; end < all.size(); ++end) REQUIRE(all[end].slots == 0);
    }
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
