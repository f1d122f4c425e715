// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Lit scenes, drawn exactly, and how far their pictures are from the reference renderer's.
#include <pellucid/measure/coverage.hpp>
#include <pellucid/reference/renderer.hpp>
#include <string>
#include "support/scene.hpp"

namespace pellucid::test {

struct Lit {
    std::string name;
    Scene scene;
    glm::vec3 background{0, 0, 0};
};

/// Scaled RMSE and largest error in the pixels that no small move of the sample changes.
template <rhi::Backend B>
[[nodiscard]] measure::ImageError error_of(typename B::Device& device, const Lit& lit, const RenderSettings& settings,
                                           const reference::Picture& wanted) {
    const ImageF hdr = shoot<B>(device, lit.scene, lit.scene.cameras.front(), settings).hdr;
    ImageF rgb(hdr.width, hdr.height, 3);
    for (std::size_t i = 0; i < rgb.data.size() / 3; ++i)
        std::copy_n(hdr.data.data() + 4 * i, 3, rgb.data.data() + 3 * i);
    const auto error = must(measure::coverage_error(rgb, wanted.radiance, wanted.stable, measure::ErrorScale::scaled));
    CHECK(error.stable_pixels > settings.size.width * settings.size.height / 2);
    CHECK(error.stable.nonfinite + error.unstable.nonfinite == 0);
    return error.stable;
}

[[nodiscard]] inline RenderSettings lit_settings(const Lit& lit) {
    RenderSettings settings = settings_for(96);
    settings.transparency = Transparency::abuffer;
    settings.background = lit.background;
    settings.keep_gbuffer = false;
    return settings;
}

}  // namespace pellucid::test
