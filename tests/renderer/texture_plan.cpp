// SPDX-License-Identifier: MIT
// How a scene's textures are gathered in arrays, and what becomes of those that do not fit.
#include <cstdlib>
#include <pellucid/renderer/texture_levels.hpp>
#include <pellucid/scene/texture_plan.hpp>
#include "support/catch.hpp"

using namespace pellucid;

namespace {
/// A scene whose material `i` uses texture `i`, of image `i`, as base colour.
struct Textures {
    Scene scene;
    std::uint32_t add(std::uint32_t w, std::uint32_t h, TextureSampler sampler = {}) {
        scene.images.push_back({Image8(w, h, 4), "image"});
        scene.textures.push_back({.image = static_cast<std::uint32_t>(scene.images.size() - 1), .sampler = sampler});
        const auto index = static_cast<std::uint32_t>(scene.textures.size() - 1);
        scene.materials.push_back({});
        scene.materials.back().base_color_texture.texture = index;
        return index;
    }
};
constexpr TextureSampler clamped{.wrap_u = TextureWrap::clamp, .wrap_v = TextureWrap::clamp};

/// Every texture that is used has a place in an array of its encoding that holds its image.
void check_places(const Scene& scene, const TexturePlan& plan) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        for (const bool srgb : {true, false}) {
            const TexturePlan::Place place = (srgb ? plan.as_color : plan.as_data)[i];
            if (place.array == no_index) continue;
            REQUIRE(place.array < plan.arrays.size());
            const TextureArrayPlan& array = plan.arrays[place.array];
            REQUIRE(array.srgb == srgb);
            REQUIRE(place.layer < array.images.size());
            REQUIRE(array.images[place.layer] == scene.textures[i].image);
        }
}
}  // namespace

TEST_CASE("textures of one size, encoding and sampler share an array", "[cpu]") {
    Textures t;
    for (int i = 0; i < 5; ++i) t.add(16, 8);
    t.add(8, 16);
    t.add(16, 8, clamped);
    const TexturePlan plan = plan_textures(t.scene, 8);
    REQUIRE(plan.arrays.size() == 3);
    CHECK(plan.arrays[0].images.size() == 5);
    CHECK(plan.warnings.empty());
    for (const TextureArrayPlan& a : plan.arrays) CHECK(a.srgb);
    for (const TexturePlan::Place& p : plan.as_data) CHECK(p.array == no_index);
    check_places(t.scene, plan);
}

TEST_CASE("a picture used as colour and as data lies in two arrays, and twice in none", "[cpu]") {
    Textures t;
    const std::uint32_t picture = t.add(4, 4);
    t.scene.materials[0].normal_texture.texture = picture;
    t.scene.materials[0].emissive_texture.texture = picture;
    t.scene.materials.push_back(t.scene.materials[0]);
    t.scene.textures.push_back({.image = 0});  // another name for the same picture
    t.scene.materials[1].base_color_texture.texture = 1;
    const TexturePlan plan = plan_textures(t.scene, 8);
    REQUIRE(plan.arrays.size() == 2);
    CHECK(plan.arrays[0].images.size() == 1);
    CHECK(plan.arrays[1].images.size() == 1);
    CHECK(plan.as_color[0].array != plan.as_data[0].array);
    CHECK(plan.as_color[1].array == plan.as_color[0].array);
    CHECK(plan.as_color[1].layer == plan.as_color[0].layer);
    check_places(t.scene, plan);
}

TEST_CASE("textures without a picture, or that nothing uses, take no place", "[cpu]") {
    Textures t;
    t.add(4, 4);
    t.scene.textures.push_back({});  // no image
    t.scene.materials[0].occlusion_texture.texture = 1;
    t.scene.images.push_back({Image8(2, 2, 4), "unused"});
    t.scene.textures.push_back({.image = 1});
    const TexturePlan plan = plan_textures(t.scene, 8);
    CHECK(plan.arrays.size() == 1);
    CHECK(plan.as_data[1].array == no_index);
    CHECK(plan.as_color[2].array == no_index);
}

TEST_CASE("an array of too many layers is followed by another", "[cpu]") {
    Textures t;
    for (int i = 0; i < 7; ++i) t.add(4, 4);
    const TexturePlan plan = plan_textures(t.scene, 8, 3);
    REQUIRE(plan.arrays.size() == 3);
    for (const TextureArrayPlan& a : plan.arrays) CHECK(a.images.size() <= 3);
    check_places(t.scene, plan);
}

TEST_CASE("too many kinds are merged, the most alike first, each with a warning", "[cpu]") {
    Textures t;
    for (const std::uint32_t size : {4u, 8u, 256u, 512u}) t.add(size, size);
    const TexturePlan plan = plan_textures(t.scene, 3);
    REQUIRE(plan.arrays.size() == 3);
    REQUIRE(plan.warnings.size() == 1);
    CHECK(plan.warnings[0].find("4x4") != std::string::npos);
    CHECK(plan.warnings[0].find("8x8") != std::string::npos);
    CHECK(plan.as_color[0].array == plan.as_color[1].array);  // the small ones
    CHECK(plan.arrays[plan.as_color[0].array].size == Extent2D{8, 8});
    check_places(t.scene, plan);
    // Another size is given up before another sampler.
    Textures s;
    s.add(64, 64);
    s.add(64, 64, clamped);
    s.add(128, 128);
    const TexturePlan mixed = plan_textures(s.scene, 2);
    REQUIRE(mixed.arrays.size() == 2);
    CHECK(mixed.as_color[0].array == mixed.as_color[2].array);
    CHECK(mixed.arrays[mixed.as_color[1].array].sampler == clamped);
    check_places(s.scene, mixed);
    // Colour and data never share, whatever happens.
    Textures d;
    for (std::uint32_t i = 0; i < 12; ++i) {
        const std::uint32_t index = d.add(4 + i, 4, i % 2 ? clamped : TextureSampler{});
        if (i % 3 == 0) d.scene.materials[i].normal_texture.texture = index;
    }
    const TexturePlan least = plan_textures(d.scene, 2);
    REQUIRE(least.arrays.size() == 2);
    CHECK(least.arrays[0].srgb != least.arrays[1].srgb);
    check_places(d.scene, least);
}

TEST_CASE("merging keeps every array within the device's layers", "[cpu]") {
    Textures t;
    for (std::uint32_t i = 0; i < 10; ++i) t.add(4, 4 + i % 5);
    const TexturePlan plan = plan_textures(t.scene, 3, 4);  // 10 pictures fit in 3 · 4 layers
    REQUIRE(plan.arrays.size() <= 3);
    for (const TextureArrayPlan& a : plan.arrays) CHECK(a.images.size() <= 4);
    check_places(t.scene, plan);
}

TEST_CASE("a resized picture keeps constants, ends and linear ramps", "[cpu]") {
    Image8 ramp(8, 1, 4);
    for (std::uint32_t x = 0; x < 8; ++x)
        for (std::uint32_t c = 0; c < 4; ++c) ramp.texel(x, 0)[c] = static_cast<std::uint8_t>(16 * x + 64 * (c == 3));
    CHECK(resized(ramp, {8, 1}, true).data == ramp.data);
    const Image8 wide = resized(ramp, {16, 3}, false);
    REQUIRE(wide.width == 16);
    REQUIRE(wide.height == 3);
    for (std::uint32_t y = 0; y < 3; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) {
            const double at = std::clamp((x + 0.5) / 2 - 0.5, 0.0, 7.0);
            CHECK(std::abs(wide.texel(x, y)[0] - 16 * at) <= 0.5);
            CHECK(std::abs(wide.texel(x, y)[3] - (16 * at + 64)) <= 0.5);
        }
    Image8 grey(3, 5, 4);
    std::fill(grey.data.begin(), grey.data.end(), std::uint8_t{77});
    for (const bool srgb : {true, false})
        for (const std::uint8_t v : resized(grey, {7, 11}, srgb).data) CHECK(v == 77);
    // Colours are mixed in linear light: half of black and white is code 188, alpha stays linear.
    Image8 step(2, 1, 4);
    for (std::uint32_t c = 0; c < 4; ++c) step.texel(1, 0)[c] = 255;
    const Image8 mixed = resized(step, {3, 1}, true);
    CHECK(std::abs(mixed.texel(1, 0)[0] - 188) <= 1);
    CHECK(std::abs(mixed.texel(1, 0)[3] - 128) <= 1);
}

TEST_CASE("levels are made where the sampler wants them", "[cpu]") {
    CHECK(texture_levels(Image8(8, 4, 4), {8, 4}, true, true).size() == 4);
    CHECK(texture_levels(Image8(8, 4, 4), {8, 4}, true, false).size() == 1);
    CHECK(texture_levels(Image8(8, 4, 4), {16, 16}, false, true).size() == 5);
}
