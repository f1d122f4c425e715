// SPDX-License-Identifier: MIT
// Alpha at the ends of its range, light that hides nothing, and radiance far above 1.
#include <algorithm>
#include <array>
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

const glm::vec4 four[] = {
    {1, 0.25f, 0.5f, 0}, {0.25f, 1, 0.75f, 1.0f / 255.0f}, {0.5f, 0.125f, 1, 254.0f / 255.0f}, {0.75f, 0.5f, 0.25f, 1}};

/// A patch for each of the 24 depth orders of the four sheets, drawn in the order `draws`.
KnownScene orders(const std::array<std::size_t, 4>& draws) {
    Patches patches("alpha 0, 1/255, 254/255 and 1 in every order", 6, 4, 8, {0.5f, 0.25f, 0.75f});
    std::array<std::size_t, 4> nearest_first{0, 1, 2, 3};
    std::size_t patch = 0;
    do {
        for (const std::size_t i : draws) {
            const auto rank =
                std::find(nearest_first.begin(), nearest_first.end(), i) - nearest_first.begin();  // 0: nearest
            patches.add(patch, static_cast<std::uint32_t>(200 - 50 * rank), four[i]);
        }
        std::vector<Layer> layers;
        for (const std::size_t i : nearest_first) layers.push_back(straight(four[i]));
        patches.expect(patch++, std::move(layers));
    } while (std::next_permutation(nearest_first.begin(), nearest_first.end()));
    REQUIRE(patch == patches.count());
    return patches.known();
}

/// Light alone, in front of, between and behind glass, stacked in several places and in one, hidden by alpha 1.
KnownScene lights() {
    const glm::dvec3 background{0.5, 0.25, 0.75};
    Patches patches("additive light", 4, 2, 8, glm::vec3(background));
    const glm::vec3 light{0.5f, 2, 0.125f}, other{3, 0.25f, 1};
    const glm::vec4 glass{0.75f, 0.5f, 0.25f, 0.5f}, wall{0.25f, 0.75f, 0.5f, 1};
    const glm::dvec3 l(light), o(other), tint(0.75, 0.5, 0.25);
    const auto expect = [&](std::size_t patch, std::vector<Layer> layers, const glm::dvec3& radiance) {
        patches.expect(patch, {std::move(layers), background, radiance});
    };
    patches.add(0, 100, glowing(light));
    expect(0, {glow(light)}, l + background);
    patches.add(1, 50, glass);
    patches.add(1, 100, glowing(light));
    expect(1, {glow(light), straight(glass)}, l + 0.5 * tint + 0.5 * background);
    patches.add(2, 100, glass);
    patches.add(2, 50, glowing(light));
    expect(2, {straight(glass), glow(light)}, 0.5 * tint + 0.5 * l + 0.5 * background);
    patches.add(3, 50, glass);
    patches.add(3, 100, glowing(light));
    patches.add(3, 150, glass);
    expect(3, {straight(glass), glow(light), straight(glass)}, 0.5 * tint + 0.5 * l + 0.25 * tint + 0.25 * background);
    for (std::uint32_t i = 0; i < 6; ++i) patches.add(4, 100 + i, glowing(i % 2 ? light : other));
    expect(4, {glow(light), glow(other), glow(light), glow(other), glow(light), glow(other)},
           3.0 * l + 3.0 * o + background);
    for (std::uint32_t i = 0; i < 6; ++i) patches.add(5, 100, glowing(i % 2 ? light : other));
    patches.add(5, 100, glass);  // in front of them all: it is drawn last
    expect(5, {straight(glass), glow(light), glow(other), glow(light), glow(other), glow(light), glow(other)},
           0.5 * tint + 1.5 * l + 1.5 * o + 0.5 * background);
    patches.add(6, 50, glowing(light));
    patches.add(6, 100, wall);  // translucent by its material, alpha 1
    patches.add(6, 150, glowing(other));
    expect(6, {glow(other), straight(wall), glow(light)}, o + glm::dvec3(0.25, 0.75, 0.5));
    Material half = glowing(light);  // premultiplied with some alpha: radiance whole, half of what is behind
    half.base_color.a = 0.5f;
    patches.add(7, 100, half);
    patches.add(7, 50, glowing(other));
    expect(7, {{l, 0.5}, glow(other)}, l + 0.5 * o + 0.5 * background);
    return patches.known();
}

/// Radiance 10000, translucent and opaque, behind glass that lets half, 1/255 and nothing through; sums beyond what
/// binary16 holds.
KnownScene bright() {
    Patches patches("radiance 10000 behind glass", 4, 2);
    const glm::vec4 half{0.5f, 0.25f, 1, 0.5f}, thick{0.5f, 0.25f, 1, 254.0f / 255.0f}, wall{0.5f, 0.25f, 1, 1};
    const glm::vec3 sun{10000, 5000, 20000};
    const glm::dvec3 s(sun);
    std::size_t patch = 0;
    for (const glm::vec4& glass : {half, thick, wall}) {
        const double a = glass.a;
        patches.add(patch, 50, shining(sun, 1, AlphaMode::opaque));
        patches.add(patch, 100, glass);
        patches.expect(patch++, {{straight(glass)}, s, a * glm::dvec3(glass) + (1 - a) * s});
    }
    for (std::uint32_t i = 0; i < 5; ++i) patches.add(patch, 100 + i, half);
    patches.add(patch, 50, shining(sun, 0.25f));
    patches.expect(patch++,
                   {{straight(half), straight(half), straight(half), straight(half), straight(half), {0.25 * s, 0.25}},
                    {0, 0, 0},
                    31.0 / 32 * glm::dvec3(half) + 0.25 / 32 * s});
    for (std::uint32_t i = 0; i < 5; ++i) patches.add(patch, 100 + i, thick);
    patches.add(patch, 50, glowing(sun));
    const double through = std::pow(1 - static_cast<double>(254.0f / 255.0f), 5);
    std::vector<Layer> layers(5, straight(thick));
    layers.push_back(glow(sun));
    patches.expect(patch++, {layers, {0, 0, 0}, (1 - through) * glm::dvec3(thick) + through * s});
    for (std::uint32_t i = 0; i < 8; ++i) patches.add(patch, 100 + i, glowing(sun));
    patches.expect(patch++, {std::vector<Layer>(8, glow(sun)), {0, 0, 0}, 8.0 * s});  // 80000, 40000, 160000
    return patches.known();
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: alpha 0, 1/255, 254/255 and 1 in all 24 orders", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = orders({0, 1, 2, 3});
    check_known(known);
    check_exact<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
    // Nor does the order of drawing matter, by a single bit.
    for (const Transparency method : methods_exact(Exactness::single_depths)) {
        std::vector<ImageF> pictures;
        for (const std::array<std::size_t, 4>& draws :
             {std::array<std::size_t, 4>{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}})
            pictures.push_back(composite<TestType>(*device, orders(draws), method).hdr);
        INFO(name(method));
        CHECK(must(measure::order_variance(pictures)).bit_equal());
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: light that hides nothing", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = lights();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_as_if_lit<TestType>(*device, known);
    KnownScene single = known;  // without the one where several share a depth
    single.at = [at = known.at](std::uint32_t x, std::uint32_t y) {
        const std::size_t which = at(x, y);
        return which == 5 ? KnownScene::unknown : which;
    };
    check_within<TestType>(*device, single, Transparency::dual_peel);
}

TEMPLATE_LIST_TEST_CASE("hard cases: radiance 10000 behind glass", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = bright();
    check_known(known);
    check_exact<TestType>(*device, known);
    check_within<TestType>(*device, known, Transparency::dual_peel);
}

TEST_CASE("hard cases: alpha, light and radiance are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{orders({0, 1, 2, 3}), lights(), bright()});
}
