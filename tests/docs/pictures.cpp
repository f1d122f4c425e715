// SPDX-License-Identifier: MIT
// The pictures of the pages are those that their commands draw today (docs/draw has drawn them again).
#include <pellucid/scene/image_file.hpp>
#include <support/skip.hpp>
#include "markdown.hpp"
#include "samples/pellucid_viewer/layout.hpp"
#include <cmath>
#include <imgui.h>

using namespace pellucid;

namespace {
/// Of codes, of the columns [first, end); both of one size.
double rmse(const Image8& a, const Image8& b, std::uint32_t first, std::uint32_t end) {
    double sum = 0;
    for (std::uint32_t y = 0; y < a.height; ++y)
        for (std::size_t i = std::size_t{first} * a.channels; i < std::size_t{end} * a.channels; ++i) {
            const double d = (double(a.texel(0, y)[i]) - double(b.texel(0, y)[i])) / 255;
            sum += d * d;
        }
    return std::sqrt(sum / (double(end - first) * a.height * a.channels));
}
}  // namespace

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
        // The pages' panels of the viewer are ImGui 1.89's; later versions place a slider's grab a pixel beside.
        const bool other_panel = IMGUI_VERSION_NUM >= 19000 && name.starts_with("viewer-");
        const std::uint32_t panel = other_panel ? samples::viewer::panel_width : 0;
        // Another processor's Mesa rounds some codes otherwise; another picture is far below this.
        CHECK(rmse(*shown, *drawn, panel, shown->width) < 0.004);
        if (panel > 0) CHECK(rmse(*shown, *drawn, 0, panel) < 0.02);
        ++count;
    }
    CHECK(count > 20);
}
