// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the reference renderer is to draw where a renderer on a device is given the same scene and settings, and what a
/// display shows of it.
#include <pellucid/reference/renderer.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/reference/tonemap.hpp>
#include <pellucid/renderer/needs.hpp>

namespace pellucid::samples {

[[nodiscard]] inline reference::RenderOptions reference_options(const Scene& scene, const RenderSettings& s) {
    reference::RenderOptions how{.size = s.size,
                                 .background = glm::dvec3(s.background),
                                 .lights = scene.lights,
                                 .brdf = static_cast<reference::BrdfModel>(s.brdf),  // the same names in one order
                                 .environment = s.environment,
                                 .shadows = s.shadows != Shadows::none,
                                 .translucent = s.transparency != Transparency::none};
    if (gets_default_sun(scene, s)) {
        how.lights.push_back(default_sun());
        if (s.environment.kind == EnvironmentKind::none) how.ambient = glm::dvec3(static_cast<double>(default_ambient));
    }
    return how;
}

/// `[h, w, 4]` sRGB codes of linear radiance `[h, w, 3]` or `[h, w, 4]`, by the settings' exposure and tone curve.
[[nodiscard]] inline Image8 display_picture(const RenderSettings& s, const ImageF& radiance) {
    const auto curve = s.tonemap == ToneCurve::none       ? reference::ToneMap::none
                       : s.tonemap == ToneCurve::reinhard ? reference::ToneMap::reinhard
                       : s.tonemap == ToneCurve::neutral  ? reference::ToneMap::neutral
                       : s.tonemap == ToneCurve::aces     ? reference::ToneMap::aces
                                                          : reference::ToneMap::agx;
    Image8 display(radiance.width, radiance.height, 4);
    for (std::size_t i = 0; i < display.data.size() / 4; ++i) {
        const float* const from = &radiance.data[i * radiance.channels];
        const glm::dvec3 mapped =
            reference::tone_map(curve, static_cast<double>(s.exposure_ev), glm::dvec3(from[0], from[1], from[2]));
        for (int c = 0; c < 3; ++c)
            display.data[4 * i + static_cast<std::size_t>(c)] = reference::srgb8_from_linear(mapped[c]);
        display.data[4 * i + 3] = 255;
    }
    return display;
}

}  // namespace pellucid::samples
