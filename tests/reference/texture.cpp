// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <pellucid/reference/texture.hpp>
#include "sampling.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::reference;
using pellucid::test::Random;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A picture whose red channel holds `codes`, in rows; green is 255 less that, blue 0, alpha half of it.
Image8 picture(std::uint32_t width, std::uint32_t height, std::initializer_list<int> codes) {
    Image8 image(width, height, 4);
    std::size_t i = 0;
    for (const int code : codes) {
        image.data[4 * i] = static_cast<std::uint8_t>(code);
        image.data[4 * i + 1] = static_cast<std::uint8_t>(255 - code);
        image.data[4 * i + 3] = static_cast<std::uint8_t>(code / 2);
        ++i;
    }
    return image;
}
/// Levels of one colour each, 2^(n−1) texels wide: the code of level i is `codes[i]`.
SampledTexture flat_levels(std::initializer_list<int> codes, const TextureSampler& sampler) {
    SampledTexture texture{.levels = {}, .sampler = sampler, .srgb = false};
    auto side = 1u << (codes.size() - 1);
    for (const int code : codes) {
        Image8 level(side, side, 4);
        std::fill(level.data.begin(), level.data.end(), static_cast<std::uint8_t>(code));
        texture.levels.push_back(std::move(level));
        side /= 2;
    }
    return texture;
}
TextureSampler sampler(TextureFilter min, TextureFilter mag, TextureFilter mip, bool mipmapped,
                       TextureWrap wrap = TextureWrap::repeat) {
    return {.min = min, .mag = mag, .mip = mip, .mipmapped = mipmapped, .wrap_u = wrap, .wrap_v = wrap};
}
using enum TextureFilter;

}  // namespace

TEST_CASE("texture: indices wrap, mirror and clamp on both sides of zero", "[cpu]") {
    constexpr int at[] = {-7, -4, -3, -1, 0, 2, 3, 5, 6, 8, 300};
    constexpr std::uint32_t repeat[] = {2, 2, 0, 2, 0, 2, 0, 2, 0, 2, 0};
    constexpr std::uint32_t mirror[] = {0, 2, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    constexpr std::uint32_t clamp[] = {0, 0, 0, 0, 0, 2, 2, 2, 2, 2, 2};
    for (std::size_t i = 0; i < std::size(at); ++i) {
        CAPTURE(at[i]);
        CHECK(wrapped(at[i], 3, TextureWrap::repeat) == repeat[i]);
        CHECK(wrapped(at[i], 3, TextureWrap::mirror) == mirror[i]);
        CHECK(wrapped(at[i], 3, TextureWrap::clamp) == clamp[i]);
        CHECK(wrapped(at[i], 1, TextureWrap::mirror) == 0);
    }
}

TEST_CASE("texture: nearest takes the texel that the point lies in, the right one on a border", "[cpu]") {
    SampledTexture t{.levels = {picture(2, 2, {10, 20, 30, 40})}, .sampler = sampler(nearest, nearest, nearest, false)};
    const auto red = [&](double u, double v) { return std::lround(sample(t, {u, v}, -1.0).r * 255); };
    CHECK(red(0.2, 0.2) == 10);
    CHECK(red(0.7, 0.2) == 20);
    CHECK(red(0.2, 0.7) == 30);  // row 0 is at v = 0
    CHECK(red(0.5, 0.5) == 40);
    CHECK(red(0, 0) == 10);
    CHECK(red(1, 0) == 10);  // repeated
    CHECK(red(-0.01, 0) == 20);
    CHECK(red(7.3, -3.4) == 30);
    t.sampler.wrap_u = t.sampler.wrap_v = TextureWrap::mirror;
    CHECK(red(1.1, 0.2) == 20);
    CHECK(red(-0.1, 0.2) == 10);
    CHECK(red(1.7, 0.2) == 10);
    CHECK(red(2.3, -0.7) == 30);
    t.sampler.wrap_u = t.sampler.wrap_v = TextureWrap::clamp;
    CHECK(red(1.1, 0.2) == 20);
    CHECK(red(-9, 99) == 30);
    CHECK(red(1, 1) == 40);
}

TEST_CASE("texture: bilinear weighs the four texels around, across every kind of border", "[cpu]") {
    SampledTexture t{.levels = {picture(4, 1, {0, 100, 200, 40})}, .sampler = sampler(linear, linear, nearest, false)};
    const auto red = [&](double u) { return sample(t, {u, 0.5}, -1.0).r * 255; };
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
        t.sampler.wrap_u = wrap;
        CHECK(red(0.125) == Approx(0).margin(1e-12));  // centres
        CHECK(red(0.375) == Approx(100).epsilon(1e-14));
        CHECK(red(0.25) == Approx(50).epsilon(1e-14));
        CHECK(red(0.4375) == Approx(125).epsilon(1e-14));
    }
    t.sampler.wrap_u = TextureWrap::repeat;
    CHECK(red(0) == Approx(20).epsilon(1e-14));  // texels 3 and 0
    CHECK(red(1) == Approx(20).epsilon(1e-14));
    CHECK(red(-0.0625) == Approx(0.75 * 40).epsilon(1e-14));
    t.sampler.wrap_u = TextureWrap::mirror;
    CHECK(red(0) == Approx(0).margin(1e-12));
    CHECK(red(1) == Approx(40).epsilon(1e-14));
    CHECK(red(1.25) == Approx(120).epsilon(1e-14));  // texels 3 and 2
    CHECK(red(-0.25) == Approx(50).epsilon(1e-14));
    t.sampler.wrap_u = TextureWrap::clamp;
    CHECK(red(1) == Approx(40).epsilon(1e-14));
    CHECK(red(1e30) == Approx(40).epsilon(1e-14));
    CHECK(red(-1e30) == Approx(0).margin(1e-12));
    // Two rows: shares multiply.
    SampledTexture grid{.levels = {picture(2, 2, {0, 100, 200, 40})},
                        .sampler = sampler(linear, linear, nearest, false)};
    const double x = 0.3, y = 0.9;
    CHECK(sample(grid, {0.25 + 0.5 * x, 0.25 + 0.5 * y}, -1.0).r * 255 ==
          Approx((1 - y) * 100 * x + y * (200 * (1 - x) + 40 * x)).epsilon(1e-14));
}

TEST_CASE("texture: sRGB texels are averaged in linear light, alpha and data as they are", "[cpu]") {
    const Image8 image = picture(2, 1, {0, 255});
    const TextureSampler s = sampler(linear, linear, nearest, false);
    const glm::dvec4 color = sample(sampled_texture(image, s, true), {0.5, 0.5}, -1.0);
    const glm::dvec4 data = sample(sampled_texture(image, s, false), {0.5, 0.5}, -1.0);
    CHECK(color.r == Approx(0.5).epsilon(1e-14));
    CHECK(color.a == Approx(127 / 510.0).epsilon(1e-14));
    CHECK(data.r == Approx(0.5).epsilon(1e-14));
    const glm::dvec4 quarter = sample(sampled_texture(picture(1, 1, {128}), s, true), {0.5, 0.5}, -1.0);
    CHECK(quarter.r == Approx(std::pow((128 / 255.0 + 0.055) / 1.055, 2.4)).epsilon(1e-14));
    CHECK(quarter.a == Approx(64 / 255.0).epsilon(1e-14));
}

TEST_CASE("texture: the level of detail is log2 of the longer derivative in texels", "[cpu]") {
    CHECK(level_of_detail({64, 16}, {1.0 / 64, 0}, {0, 1.0 / 16}) == Approx(0).margin(1e-14));
    CHECK(level_of_detail({64, 16}, {1.0 / 64, 0}, {0, 4.0 / 16}) == Approx(2).epsilon(1e-14));
    CHECK(level_of_detail({64, 16}, {3.0 / 64, 4.0 / 16}, {0, 0}) == Approx(std::log2(5)).epsilon(1e-14));
    CHECK(level_of_detail({64, 64}, {-0.5, 0}, {0.1, 0.1}) == Approx(5).epsilon(1e-14));
    CHECK(level_of_detail({64, 64}, {0, 0}, {0, 0}) == -infinity);
    CHECK(level_of_detail({64, 64}, {infinity, 0}, {0, 0}) == infinity);
    CHECK(level_of_detail({64, 64}, {std::nan(""), 0}, {0, 0}) == infinity);
}

TEST_CASE("texture: min, mag and mip filters each have their range of levels", "[cpu]") {
    const auto value = [](const SampledTexture& t, double lambda) { return sample(t, {0.3, 0.6}, lambda).r * 255; };
    SampledTexture t = flat_levels({40, 80, 160, 240}, sampler(linear, linear, linear, true));
    CHECK(value(t, -infinity) == 40);
    CHECK(value(t, 0) == 40);
    CHECK(value(t, 0.25) == Approx(50).epsilon(1e-14));  // trilinear
    CHECK(value(t, 1) == Approx(80).epsilon(1e-14));
    CHECK(value(t, 1.75) == Approx(140).epsilon(1e-14));
    CHECK(value(t, 3) == Approx(240).epsilon(1e-14));
    CHECK(value(t, infinity) == Approx(240).epsilon(1e-14));
    t.sampler.mip = nearest;
    CHECK(value(t, 0.5) == 40);  // half rounds down
    CHECK(value(t, 0.5000001) == Approx(80));
    CHECK(value(t, 1.5) == Approx(80));
    CHECK(value(t, 2.6) == Approx(240));
    CHECK(value(t, infinity) == Approx(240));
    // Magnified (λ <= 0) and minified samples of one level tell `mag` from `min`.
    SampledTexture one{.levels = {picture(2, 1, {0, 200})}, .sampler = sampler(nearest, linear, nearest, false)};
    CHECK(sample(one, {0.4, 0.5}, 0.0).r * 255 == Approx(200 * 0.3).epsilon(1e-14));
    CHECK(sample(one, {0.4, 0.5}, 1e-9).r == 0);
    CHECK(sample(one, {0.4, 0.5}, infinity).r == 0);
    // By derivatives of half a texel a pixel, and of two.
    CHECK(sample(one, {0.4, 0.5}, {0.25, 0}, {0, 0}).r * 255 == Approx(60).epsilon(1e-14));
    CHECK(sample(one, {0.4, 0.5}, {0, 0}, {1, 0}).r == 0);
}

TEST_CASE("texture: the levels are the renderer's, and one alone without mipmaps", "[cpu]") {
    const Image8 image = picture(5, 3, {0, 255, 9, 4, 2, 90, 80, 70, 60, 50, 1, 2, 3, 255, 254});
    const TextureSampler with = sampler(linear, linear, linear, true);
    const auto same = [](const std::vector<Image8>& a, const std::vector<Image8>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](const Image8& x, const Image8& y) { return x.width == y.width && x.data == y.data; });
    };
    CHECK(same(sampled_texture(image, with, true).levels, make_mipmaps(image, MipContent::color_with_alpha)));
    CHECK(same(sampled_texture(image, with, false).levels, make_mipmaps(image, MipContent::data)));
    TextureSampler without = with;
    without.mipmapped = false;
    CHECK(same(sampled_texture(image, without, true).levels, {image}));
}

TEST_CASE("texture: any finite coordinate has a value within its texels, and periods repeat", "[cpu]") {
    Random random(4);
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp}) {
        const SampledTexture t = sampled_texture(picture(3, 2, {20, 200, 60, 90, 120, 30}),
                                                 sampler(linear, linear, linear, true, wrap), false);
        for (int i = 0; i < 20000; ++i) {
            const double scale = std::pow(10.0, random.uniform(-3, 300));
            const glm::dvec2 uv(random.uniform(-scale, scale), random.uniform(-scale, scale));
            const double red = sample(t, uv, random.uniform(-1, 3)).r * 255;
            REQUIRE(red >= 20 - 1e-9);
            REQUIRE(red <= 200 + 1e-9);
        }
        if (wrap == TextureWrap::clamp) continue;
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 uv(random.uniform(-2, 2), random.uniform(-2, 2));
            REQUIRE(sample(t, uv, 0.0).r == Approx(sample(t, uv + glm::dvec2(4, -6), 0.0).r).epsilon(1e-12));
        }
    }
}
