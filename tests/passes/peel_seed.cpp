// SPDX-License-Identifier: MIT
// Depth peeling as the document the project grew from has it: right where its six layers of 8 bits are enough, and
// each of its defects where it says it is.
#include "support/known_scenes.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

constexpr double code = 1 / 255.0;  ///< a unit of 8 bits

/// Least and largest result for `layers`, nearest first: each is stored in 8 bits, limited to 1, and added to a sum in
/// 8 bits; each store and each sum is off by up to a unit.  `behind_share(T)`: what the last step multiplies what is
/// behind with.
template <class F>
Window seed_window(std::span<const Layer> layers, const glm::dvec3& behind, F&& behind_share) {
    glm::dvec3 least{0, 0, 0}, most{0, 0, 0};
    double low = 1, high = 1;  // T
    for (const Layer& l : layers) {
        const glm::dvec3 c = glm::min(l.color, glm::dvec3(1));
        least = glm::max(least + low * glm::max(c - code, glm::dvec3(0)) - code, glm::dvec3(0));
        most = glm::min(most + high * glm::min(c + code, glm::dvec3(1)) + code, glm::dvec3(1));
        low = std::max(0.0, low * (1 - std::min(1.0, l.alpha + code)) - code);
        high = std::min(1.0, high * (1 - std::max(0.0, l.alpha - code)) + code);
    }
    const double a = behind_share(low), b = behind_share(high);
    return {(least + std::min(a, b) * behind) * (1 - 0x1p-9), (most + std::max(a, b) * behind) * (1 + 0x1p-9)};
}
Window seed_window(std::span<const Layer> layers, const glm::dvec3& behind) {
    return seed_window(layers, behind, [](double through) { return through; });
}

/// Pixels of a patch outside of the window.
std::size_t outside(const ImageF& hdr, const KnownScene& known, std::size_t patch, const Window& wanted) {
    std::size_t count = 0, seen = 0;
    for (std::uint32_t y = 0; y < hdr.height; ++y)
        for (std::uint32_t x = 0; x < hdr.width; ++x) {
            if (known.at(x, y) != patch) continue;
            ++seen;
            count += !wanted.holds(hdr.texel(x, y));
        }
    REQUIRE(seen > 0);
    return count;
}
const float* corner(const ImageF& hdr, std::size_t patch, std::size_t columns) {
    return hdr.texel(static_cast<std::uint32_t>(Patches::side * (patch % columns)),
                     static_cast<std::uint32_t>(Patches::side * (patch / columns)));
}
bool holds(const Window& window, const glm::dvec3& value) {
    const glm::vec3 v(value);
    return window.holds(&v.x);
}

const glm::dvec3 background{0.5, 0.25, 0.75};

}  // namespace

TEMPLATE_LIST_TEST_CASE("peel_seed: up to six layers are composited, more are lost", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Dark and thin ones before, white ones behind: what is lost is far more than 8 bits explain.
    const auto color = [](std::uint32_t i, std::size_t limit) {
        return i < limit ? glm::vec4(0.1f, i % 2 ? 0.25f : 0.0f, 0.0f, 0.125f) : glm::vec4(1, 1, 1, 0.75f);
    };
    for (const std::uint32_t setting : {0u, 3u, 8u}) {
        const std::size_t limit = setting ? setting : 6;
        Patches patches("layers", 5, 2);
        std::vector<std::vector<Layer>> layers(patches.count());
        for (std::size_t patch = 0; patch < patches.count(); ++patch)
            for (std::uint32_t i = 0; i < patch + 1; ++i) {
                patches.add(patch, 200 - 15 * i, color(i, limit));
                layers[patch].push_back(straight(color(i, limit)));
            }
        KnownScene known = patches.known();
        known.settings.max_layers = setting;
        const ImageF got = composite<TestType>(*device, known, Transparency::peel_seed).hdr;
        for (std::size_t patch = 0; patch < patches.count(); ++patch) {
            std::vector<Layer> left = layers[patch];
            left.resize(std::min(left.size(), limit));
            const Window window = seed_window(left, {0, 0, 0});
            INFO(patch + 1 << " layers, at most " << limit << ": " << to_text(corner(got, patch, 5)) << ", may be "
                           << to_text(window.lower) << " to " << to_text(window.upper));
            CHECK(outside(got, known, patch, window) == 0);
            CHECK(holds(window, over(layers[patch], {0, 0, 0})) == (patch + 1 <= limit));
        }
    }
}

TEMPLATE_LIST_TEST_CASE("peel_seed: layers within 1e-4 of depth vanish, those of equal depth too", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    // Slots of 2^-16 = 1.53e-5.
    const glm::vec4 a{1, 0.25f, 0.5f, 0.5f}, b{0.125f, 1, 0.25f, 0.5f}, c{0.25f, 0.125f, 1, 0.5f};
    Patches patches("close layers", 3, 2, 16, glm::vec3(background));
    std::vector<std::vector<Layer>> left(patches.count()), all(patches.count());
    const auto expect = [&](std::size_t p, std::vector<Layer> remaining, std::vector<Layer> truth) {
        left[p] = std::move(remaining);
        all[p] = std::move(truth);
    };
    patches.add(0, 30000, a);
    patches.add(0, 30000 - 6, b);  // 0.92e-4 behind
    expect(0, {straight(a)}, {straight(a), straight(b)});
    patches.add(1, 30000, a);
    patches.add(1, 30000 - 7, b);  // 1.07e-4 behind
    expect(1, {straight(a), straight(b)}, {straight(a), straight(b)});
    patches.add(2, 30000, a);  // hides the next one, but not the one after it
    patches.add(2, 30000 - 4, b);
    patches.add(2, 30000 - 8, c);
    expect(2, {straight(a), straight(c)}, {straight(a), straight(b), straight(c)});
    patches.add(3, 30000, a);  // of equal depth: the one drawn first remains
    patches.add(3, 30000, b);
    patches.add(3, 30000, c);
    expect(3, {straight(a)}, {straight(c), straight(b), straight(a)});
    patches.add(4, (1 << 16) - 6, a);  // nothing is in front of depth 1: the same epsilon hides what is near it
    patches.add(4, 30000, b);
    expect(4, {straight(b)}, {straight(a), straight(b)});
    patches.add(5, (1 << 16) - 7, a);
    patches.add(5, 30000, b);
    expect(5, {straight(a), straight(b)}, {straight(a), straight(b)});
    const KnownScene& known = patches.known();
    const ImageF got = composite<TestType>(*device, known, Transparency::peel_seed).hdr;
    for (std::size_t patch = 0; patch < patches.count(); ++patch) {
        const Window window = seed_window(left[patch], background);
        INFO("patch " << patch << ": " << to_text(corner(got, patch, 3)) << ", may be " << to_text(window.lower)
                      << " to " << to_text(window.upper));
        CHECK(outside(got, known, patch, window) == 0);
        if (left[patch].size() != all[patch].size()) CHECK_FALSE(holds(window, over(all[patch], background)));
    }
}

TEMPLATE_LIST_TEST_CASE("peel_seed: radiance above 1 is clipped", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    Patches patches("bright layers", 2, 1, 8, glm::vec3(background));
    patches.add(0, 100, shining({4, 0.5f, 8}, 0.5f));
    patches.add(1, 100, glowing({3, 0.25f, 10000}));
    const ImageF got = composite<TestType>(*device, patches.known(), Transparency::peel_seed).hdr;
    const Layer layers[] = {{{2, 0.25, 4}, 0.5}, {{3, 0.25, 10000}, 0}};
    for (std::size_t patch = 0; patch < 2; ++patch) {
        const Window window = seed_window(std::span(&layers[patch], 1), background);
        INFO("patch " << patch << ": " << to_text(corner(got, patch, 2)));
        CHECK(outside(got, patches.known(), patch, window) == 0);
        CHECK_FALSE(holds(window, over(std::span(&layers[patch], 1), background)));
    }
}

TEMPLATE_LIST_TEST_CASE("peel_seed: composited as written, what is behind shows by what is hidden", "[gpu]", Backends) {
    const auto device = make_device<TestType>();
    if (!device) return;
    const glm::vec4 glass{1, 0.5f, 0.25f, 0.25f}, wall{0.25f, 0.5f, 0.125f, 1};
    Patches patches("composited as written", 2, 2, 8, glm::vec3(background));
    patches.add(1, 100, glass);
    patches.add(2, 50, flat(wall));
    patches.add(3, 50, flat(wall));
    patches.add(3, 100, glass);
    KnownScene known = patches.known();
    const Layer layer = straight(glass);
    for (const bool as_written : {false, true}) {
        known.settings.seed_composite = as_written;
        const ImageF got = composite<TestType>(*device, known, Transparency::peel_seed).hdr;
        for (std::size_t patch = 0; patch < 4; ++patch) {
            const glm::dvec3 behind = patch < 2 ? background : glm::dvec3(wall);
            const std::span<const Layer> layers(&layer, patch % 2);
            const Window window = seed_window(layers, behind, [&](double t) { return as_written ? 1 - t : t; });
            INFO((as_written ? "as written, patch " : "mended, patch ")
                 << patch << ": " << to_text(corner(got, patch, 2)) << ", may be " << to_text(window.lower) << " to "
                 << to_text(window.upper));
            CHECK(outside(got, known, patch, window) == 0);
            // With the mistake, a pixel that no layer covers is black.
            if (as_written && patch % 2 == 0) CHECK(corner(got, patch, 2)[0] == 0.0f);
            if (as_written) CHECK_FALSE(holds(window, over(layers, behind)));
        }
    }
}
