// SPDX-License-Identifier: MIT
// The pictures of the pages are those that their commands draw today (docs/draw has drawn them again).
#include <pellucid/scene/image_file.hpp>
#include <support/skip.hpp>
#include "markdown.hpp"
#include <cmath>

using namespace pellucid;

TEST_CASE("the pages' pictures are what their commands draw", "[docs][gpu]") {
    const std::filesystem::path again = PELLUCID_DRAWN_PICTURES;
    if (!std::filesystem::exists(again) || std::filesystem::is_empty(again)) {
        test::skip("scripts/docs has drawn nothing in " + again.string(), "PELLUCID_REQUIRE_DEVICES");
        return;
    }
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(docs::root / "docs/pictures")) {
        const std::string name = file.path().filename().string();
        INFO(name << ": scripts/docs draws the pictures anew");
        REQUIRE(std::filesystem::exists(again / name));
        auto shown = read_image(file.path().string()), drawn = read_image((again / name).string());
        REQUIRE(shown);
        REQUIRE(drawn);
        REQUIRE(shown->width == drawn->width);
        REQUIRE(shown->height == drawn->height);
        CHECK(shown->width <= 920);
        CHECK(shown->height <= 518);
        double sum = 0;
        for (std::size_t i = 0; i < shown->data.size(); ++i) {
            const double d = (double(shown->data[i]) - double(drawn->data[i])) / 255;
            sum += d * d;
        }
        // Another processor's Mesa rounds some codes otherwise; another picture is far below this.
        CHECK(std::sqrt(sum / static_cast<double>(shown->data.size())) < 0.004);
        ++count;
    }
    CHECK(count > 20);
}
