// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Closed forms of the tests against the reference renderer: both are judged.
#include <algorithm>
#include <cmath>
#include <pellucid/reference/renderer.hpp>
#include "support/known_scenes.hpp"

namespace pellucid::test {

/// The formula's answers are what compositing them in double gives, and the reference renderer draws them.
inline void check_known(const KnownScene& known) {
    INFO(known.name);
    REQUIRE_FALSE(known.pixels.empty());
    for (const KnownPixel& p : known.pixels) {
        const glm::dvec3 composited = over(p.layers, p.behind);
        for (int c = 0; c < 3; ++c)
            REQUIRE(std::abs(composited[c] - p.radiance[c]) <= 1e-11 * std::max(1.0, p.radiance[c]));
    }
    const RenderSettings& s = known.settings;
    const auto reference = must(reference::render(
        known.scene, known.camera,
        {.size = s.size, .background = glm::dvec3(s.background), .lights = known.scene.lights, .stability = true}));
    // No edge is near: there depths an ulp apart are judged too, which a pixel that is stable does not have.
    const auto inside = [&](std::uint32_t x, std::uint32_t y) {
        for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, s.size.height - 1); ++v)
            for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, s.size.width - 1); ++u)
                if (known.at(u, v) != known.at(x, y)) return false;
        return true;
    };
    std::size_t judged = 0, other_layers = 0, other_radiance = 0;
    for (std::uint32_t y = 0; y < s.size.height; ++y)
        for (std::uint32_t x = 0; x < s.size.width; ++x) {
            const std::size_t which = known.at(x, y);
            if (which == KnownScene::unknown || !(*reference.stable.texel(x, y) == 255 || inside(x, y))) continue;
            const KnownPixel& p = known.pixels[which];
            ++judged;
            other_layers += *reference.layers.texel(x, y) != p.layers.size();
            for (int c = 0; c < 3; ++c)  // rounded to float once
                other_radiance +=
                    std::abs(reference.radiance.texel(x, y)[c] - p.radiance[c]) > 1e-7 * std::max(1.0, p.radiance[c]);
        }
    CHECK(judged > 0);
    CHECK(other_layers == 0);
    CHECK(other_radiance == 0);
}

}  // namespace pellucid::test
