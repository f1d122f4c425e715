// SPDX-License-Identifier: MIT
#include <pellucid/passes/layer_areas.hpp>
#include <random>
#include "support/catch.hpp"

using namespace pellucid;

namespace {

bool contains(const rhi::Rect& area, std::uint32_t x, std::uint32_t y) {
    return x >= area.x && y >= area.y && x - area.x < area.width && y - area.y < area.height;
}

bool same(const rhi::Rect& a, const rhi::Rect& b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

}  // namespace

TEST_CASE("a picture without fragments has no areas", "[cpu]") {
    CHECK(layer_areas({}, {8, 8}).empty());
    const std::uint32_t none[6] = {};
    CHECK(layer_areas(none, {17, 16}).empty());
}

TEST_CASE("areas end where the picture does", "[cpu]") {
    const std::uint32_t depths[] = {0, 0, 1, 0, 0, 3};  // 3 × 2 tiles
    const auto areas = layer_areas(depths, {17, 10});
    REQUIRE(areas.size() == 3);
    CHECK(same(areas[0], {16, 0, 1, 10}));
    CHECK(same(areas[1], {16, 8, 1, 2}));
    CHECK(same(areas[2], {16, 8, 1, 2}));
}

TEST_CASE("areas hold every tile that is so deep, touch one at each edge, and lie in each other", "[cpu]") {
    std::mt19937 random(7);
    for (const Extent2D size : {Extent2D{1, 1}, Extent2D{8, 8}, Extent2D{9, 33}, Extent2D{100, 41}}) {
        const std::uint32_t columns = (size.width + 7) / 8, rows = (size.height + 7) / 8;
        for (int round = 0; round < 20; ++round) {
            std::vector<std::uint32_t> depths(std::size_t{columns} * rows);
            for (std::uint32_t& d : depths) d = static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 40 : 0);
            const auto areas = layer_areas(depths, size);
            REQUIRE(areas.size() == *std::max_element(depths.begin(), depths.end()));
            for (std::uint32_t k = 0; k < areas.size(); ++k) {
                const rhi::Rect& a = areas[k];
                REQUIRE((a.width > 0 && a.height > 0));
                CHECK((a.x + a.width <= size.width && a.y + a.height <= size.height));
                bool left = false, right = false, top = false, bottom = false;
                for (std::uint32_t i = 0; i < depths.size(); ++i) {
                    if (depths[i] <= k) continue;
                    const std::uint32_t x = i % columns * 8, y = i / columns * 8;
                    const std::uint32_t x1 = std::min(x + 8, size.width), y1 = std::min(y + 8, size.height);
                    CHECK((contains(a, x, y) && contains(a, x1 - 1, y1 - 1)));
                    left = left || x == a.x;
                    top = top || y == a.y;
                    right = right || x1 == a.x + a.width;
                    bottom = bottom || y1 == a.y + a.height;
                }
                CHECK((left && right && top && bottom));
                if (k > 0) {
                    const rhi::Rect& before = areas[k - 1];
                    CHECK((contains(before, a.x, a.y) && contains(before, a.x + a.width - 1, a.y + a.height - 1)));
                }
            }
        }
    }
}
