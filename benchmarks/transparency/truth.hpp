// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the pictures are compared with: the double-precision reference of the same scene and size.
#include <unistd.h>
#include <pellucid/core/half.hpp>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/reference/renderer.hpp>
#include "support/time.hpp"
#include "transparency/cases.hpp"

namespace pellucid::bench {

struct Truth {
    ImageF radiance;   ///< [h, w, 3]
    ImageF opaque;     ///< [h, w, 3] without translucent surfaces
    ImageF on_grid;    ///< [h, w, 3] `radiance` with corners moved to a grid of 1/256 pixel; empty unless asked for
    Image8 stable;     ///< [h, w, 1] 255: no surface's edge is within 1/64 pixel
    double floor = 0;  ///< scaled RMSE of `radiance` itself once it is stored in binary16, as the target stores it
    std::uint64_t unstable = 0;    ///< pixels
    std::uint32_t max_layers = 0;  ///< of a pixel
    double mean_layers = 0;        ///< of the pixels that have any
    double covered = 0;            ///< [0,1] share of these pixels
    std::uint64_t fragments = 0;   ///< all translucent ones in front of what is opaque
    double seconds = 0;            ///< that it took
};

namespace detail {

/// Says on a terminal how far a long computation is.
struct Progress {
    std::string what;
    int shown = -1;
    static void report(void* user, double fraction) {
        Progress& self = *static_cast<Progress*>(user);
        const int percent = static_cast<int>(100 * fraction);
        if (percent == self.shown) return;
        self.shown = percent;
        std::fprintf(stderr, "\r%s: %d %%%s", self.what.c_str(), percent, percent == 100 ? "\n" : "");
    }
};

}  // namespace detail

/// Errors: those of `reference::render`.
[[nodiscard]] inline Result<Truth> make_truth(const Case& c, Extent2D size, bool on_grid) {
    const double start = now_ns();
    const bool unlit_by_file = c.scene.lights.empty() && c.default_light;
    detail::Progress progress{"reference of " + c.name};
    reference::RenderOptions options{.size = size,
                                     .background = glm::dvec3(c.background),
                                     .lights = unlit_by_file ? std::vector<Light>{default_sun()} : c.scene.lights,
                                     .ambient = glm::dvec3(unlit_by_file ? default_ambient : 0.0f),
                                     .stability = true};
    if (isatty(STDERR_FILENO)) options.progress = detail::Progress::report, options.user = &progress;
    PELLUCID_TRY(reference::Picture picture, reference::render(c.scene, c.camera, options));
    options.stability = false;
    options.progress = nullptr;
    reference::Picture moved;
    if (on_grid) {
        options.corner_grid = 256;
        PELLUCID_TRY(moved, reference::render(c.scene, c.camera, options));
        options.corner_grid = 0;
    }
    options.translucent = false;
    PELLUCID_TRY(reference::Picture opaque, reference::render(c.scene, c.camera, options));

    Truth out{.radiance = std::move(picture.radiance), .opaque = std::move(opaque.radiance)};
    out.on_grid = std::move(moved.radiance);
    out.stable = std::move(picture.stable);
    std::uint64_t covered = 0;
    for (const std::uint32_t n : picture.layers.data) {
        out.max_layers = std::max(out.max_layers, n);
        out.fragments += n;
        covered += n > 0;
    }
    const auto pixels = static_cast<double>(picture.layers.data.size());
    out.covered = static_cast<double>(covered) / pixels;
    out.mean_layers = static_cast<double>(out.fragments) / static_cast<double>(std::max<std::uint64_t>(1, covered));
    ImageF stored = out.radiance;
    for (float& value : stored.data) value = half_to_float(half_toward_zero(value));
    PELLUCID_TRY(
        const measure::ImageError floor,
        measure::image_error(stored, out.radiance, {.scale = measure::ErrorScale::scaled, .mask = &out.stable}));
    out.floor = floor.rmse;
    out.unstable = floor.masked_out;
    out.seconds = (now_ns() - start) * 1e-9;
    return out;
}

}  // namespace pellucid::bench
