// SPDX-License-Identifier: MIT
/// \file
/// Mip chains: sizes, exact means for even and odd sides, linear light, weighting by alpha.
#include <pellucid/scene/mipmap.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include "support/catch.hpp"

using namespace pellucid;

TEST_CASE("sRGB: all 256 codes survive the way to linear and back", "[cpu][mipmap]") {
    for (int code = 0; code < 256; ++code)
        CHECK(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(code))) == code);
    CHECK(linear_from_srgb(0) == 0.0f);
    CHECK(linear_from_srgb(255) == 1.0f);
    CHECK(linear_from_srgb(188) == Approx(0.502886).epsilon(1e-5));
    CHECK(srgb_from_linear(0.5) == 188);
    CHECK(srgb_from_linear(-1) == 0);
    CHECK(srgb_from_linear(7) == 255);
    CHECK(srgb_from_linear(std::numeric_limits<double>::quiet_NaN()) == 0);
}

TEST_CASE("a chain goes down to one texel, rounding sizes down", "[cpu][mipmap]") {
    CHECK(mip_count({1, 1}) == 1);
    CHECK(mip_count({16384, 3}) == 15);
    CHECK(mip_count({0, 5}) == 0);
    const auto chain = make_mipmaps(Image8(13, 5, 4), MipContent::data);
    REQUIRE(chain.size() == 4);
    const Extent2D sizes[] = {{13, 5}, {6, 2}, {3, 1}, {1, 1}};
    for (std::size_t i = 0; i < 4; ++i) CHECK(Extent2D{chain[i].width, chain[i].height} == sizes[i]);
}

TEST_CASE("every source texel of an odd side counts equally", "[cpu][mipmap]") {
    // A white texel at each place of a 7-texel row: the mean over the next level is 1/7 of white, wherever it stands.
    for (std::uint32_t at = 0; at < 7; ++at) {
        Image8 row(7, 1, 4);
        row.texel(at, 0)[0] = 210;
        const auto chain = make_mipmaps(row, MipContent::data);
        REQUIRE(chain[1].width == 3);
        const int sum = chain[1].data[0] + chain[1].data[4] + chain[1].data[8];
        CHECK(sum == Approx(210.0 * 3 / 7).margin(1.0));
        // The last level is 1/7, to rounding: 30, or one of 3-texel means of thirds, all exact boxes.
        CHECK(chain[2].data[0] == 30);
    }
    // Position i of m = 3, n = 7: weights (m - i)/n, m/n, (i + 1)/n.
    Image8 row(7, 1, 4);
    row.texel(2, 0)[0] = 252;
    const auto chain = make_mipmaps(row, MipContent::data);
    CHECK(chain[1].texel(0, 0)[0] == 36);  // 252 · 1/7
    CHECK(chain[1].texel(1, 0)[0] == 72);  // 252 · 2/7
    CHECK(chain[1].texel(2, 0)[0] == 0);
}

TEST_CASE("constant pictures stay constant at every size", "[cpu][mipmap]") {
    for (const MipContent content : {MipContent::data, MipContent::color, MipContent::color_with_alpha})
        for (std::uint32_t side = 1; side <= 33; ++side) {
            Image8 image(side, 34 - side, 4);
            for (std::size_t i = 0; i < image.data.size(); ++i)
                image.data[i] = static_cast<std::uint8_t>(i % 4 * 60 + 17);
            for (const Image8& level : make_mipmaps(image, content))
                for (std::size_t i = 0; i < level.data.size(); ++i) REQUIRE(level.data[i] == i % 4 * 60 + 17);
        }
}

TEST_CASE("colour is averaged in linear light, data as it is", "[cpu][mipmap]") {
    Image8 image(2, 2, 4);
    for (const std::uint32_t x : {0u, 1u})
        for (int c = 0; c < 4; ++c) image.texel(x, x)[c] = 255;
    CHECK(make_mipmaps(image, MipContent::data)[1].data == std::vector<std::uint8_t>{128, 128, 128, 128});
    CHECK(make_mipmaps(image, MipContent::color)[1].data == std::vector<std::uint8_t>{188, 188, 188, 128});
    // The two texels that do not show are black: weighted by alpha the colour stays white.
    CHECK(make_mipmaps(image, MipContent::color_with_alpha)[1].data == std::vector<std::uint8_t>{255, 255, 255, 128});
    // Nothing shows: colours are averaged evenly.
    for (const std::uint32_t x : {0u, 1u}) image.texel(x, x)[3] = 0;
    CHECK(make_mipmaps(image, MipContent::color_with_alpha)[1].data == std::vector<std::uint8_t>{188, 188, 188, 0});
}

TEST_CASE("levels are not rounded on the way", "[cpu][mipmap]") {
    // 4096 texels of which 10 are 1/255: each rounded level would lose them; the mean is 10/4096/255 -> 0, and with
    // 2100 of them it is 0.51 -> 1.
    Image8 image(64, 64, 4);
    for (std::size_t i = 0; i < 2100; ++i) image.data[i * 4] = 1;
    CHECK(make_mipmaps(image, MipContent::data).back().data[0] == 1);
    for (std::size_t i = 2000; i < 2100; ++i) image.data[i * 4] = 0;
    CHECK(make_mipmaps(image, MipContent::data).back().data[0] == 0);
}
