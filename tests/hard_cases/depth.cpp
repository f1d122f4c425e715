// SPDX-License-Identifier: MIT
// Depths as close as float32 has them, and the very ends of the range.
#include <algorithm>
#include <array>
#include "hard_cases/check_known.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

const glm::vec4 colors[] = {
    {1, 0.25f, 0.5f, 0.5f}, {0.25f, 1, 0.75f, 0.25f}, {0.5f, 0.125f, 1, 0.75f}, {0.75f, 0.5f, 0.25f, 0.375f}};

/// Four sheets in the slots k, k + 1, k + 2 and k + 3 of 2^24: a patch for each order of drawing.  For k >= 2^23 one
/// slot is one ulp.
KnownScene ulps(std::uint32_t k) {
    Patches patches("sheets an ulp apart from slot " + std::to_string(k), 6, 4, 24, {0.5f, 0.25f, 0.75f});
    std::array<std::uint32_t, 4> order{0, 1, 2, 3};
    std::size_t patch = 0;
    do {
        for (const std::uint32_t i : order) patches.add(patch, k + i, colors[i]);
        patches.expect(patch++, {straight(colors[3]), straight(colors[2]), straight(colors[1]), straight(colors[0])});
    } while (std::next_permutation(order.begin(), order.end()));
    REQUIRE(patch == patches.count());
    return patches.known();
}

/// On the near plane (depth 1), on the far one (depth 0), an ulp off them, and all of that at once.
KnownScene ends() {
    constexpr std::uint32_t near = 1u << 24;
    const std::uint32_t slots[][4] = {{0, 0, 0, 0},
                                      {near, near, near, near},
                                      {0, 0, near, near},
                                      {0, 1, 0, 1},
                                      {near, near - 1, near, near - 1},
                                      {0, near, 1, near - 1},
                                      {near, 0, near, 0},
                                      {1u << 23, 0, near, 0}};
    Patches patches("the ends of the range", 4, 2, 24, {0.5f, 0.25f, 0.75f});
    for (std::size_t patch = 0; patch < patches.count(); ++patch) {
        std::vector<std::size_t> sheets;
        for (std::size_t i = 0; i < 4; ++i) {
            patches.add(patch, slots[patch][i], colors[i]);
            sheets.push_back(i);
        }
        std::sort(sheets.begin(), sheets.end(), [&](std::size_t a, std::size_t b) {
            return slots[patch][a] != slots[patch][b] ? slots[patch][a] > slots[patch][b] : a > b;
        });
        std::vector<Layer> layers;
        for (const std::size_t i : sheets) layers.push_back(straight(colors[i]));
        patches.expect(patch, std::move(layers));
    }
    return patches.known();
}

/// Everything is behind something opaque, by an ulp and by a lot; or in front of it by an ulp and right at it.
KnownScene hidden() {
    constexpr std::uint32_t wall = (1u << 23) + 77;
    const glm::vec4 paint{0.25f, 0.5f, 0.125f, 1};
    Patches patches("all behind something opaque", 2, 1, 24);
    for (const std::size_t patch : {0u, 1u}) {
        for (std::uint32_t i = 0; i < 4; ++i) patches.add(patch, patch ? 1000 + i : wall - 4 + i, colors[i]);
        patches.add(patch, wall, flat(paint));
        patches.expect(patch, known_pixel({}, glm::dvec3(paint)));
    }
    return patches.known();
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("hard cases: sheets an ulp apart, in all 24 orders of drawing", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    for (const std::uint32_t k : {(1u << 23), (1u << 24) - 5}) {
        const KnownScene known = ulps(k);
        check_known(known);
        check_exact<TestType>(*device, known);
        check_within<TestType>(*device, known, Transparency::dual_peel);
    }
}

TEMPLATE_LIST_TEST_CASE("hard cases: sheets on the near plane and on the far plane", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = ends();
    check_known(known);
    check_exact<TestType>(*device, known);
}

TEMPLATE_LIST_TEST_CASE("hard cases: every sheet is behind something opaque", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const KnownScene known = hidden();
    check_known(known);
    check_exact<TestType>(*device, known);
    for (const Transparency method : all_methods())
        if (facts(method).exact < Exactness::without_light) check_within<TestType>(*device, known, method);
}

TEST_CASE("hard cases: close depths are the same bits on both backends", "[gpu]") {
    check_backends_agree(std::vector{ulps(1u << 23), ends(), hidden()});
}
