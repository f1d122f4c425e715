// SPDX-License-Identifier: MIT
#include "reference.hpp"
#include "../support/reference_picture.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include <pellucid/renderer/needs.hpp>
#include <chrono>
#include <cstdio>

using namespace pellucid;

#if defined(PELLUCID_HAS_REFERENCE)

Result<reference::Picture> draw_reference(const Options& options, const Scene& scene, const Camera& camera,
                                          bool stability) {
    ProgressBar bar("reference");
    reference::RenderOptions how = samples::reference_options(scene, options.settings);
    how.stability = stability;
    how.progress = &ProgressBar::show;
    how.user = &bar;
    return reference::render(scene, camera, how);
}

#else

Result<reference::Picture> draw_reference(const Options&, const Scene&, const Camera&, bool) {
    return Error{Errc::invalid_argument, "this program was built without the reference renderer"};
}

#endif

Drawn shown(const Options& options, ImageF radiance) {
    Image8 display = samples::display_picture(options.settings, radiance);
    return {.linear = std::move(radiance), .display = std::move(display)};
}

Result<int> run_reference(const Options& options, const Scene& scene, const Camera& camera,
                          const std::optional<Target>& target) {
    const auto start = std::chrono::steady_clock::now();
    PELLUCID_TRY(reference::Picture picture, draw_reference(options, scene, camera, false));
    Report report;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    report.frame_ms = measure::summarize({took.count()});
    report.load_to_first_frame_ms = took.count();
    report.stats.warnings = scene.warnings;
    report.stats.lights = static_cast<std::uint32_t>(scene.lights.size());
    if (gets_default_sun(scene, options.settings)) report.stats.lights = 1;
    report.translucency = {.method = "reference",
                           .why = "--reference",
                           .exact = options.settings.transparency != Transparency::none || !has_translucent(scene),
                           .layers = summarize_layers(picture.layers)};
    if (!report.translucency.exact) report.translucency.loses = traits(Transparency::none).loses;
    for (const Instance& instance : scene.instances)
        report.stats.triangles += scene.meshes[instance.mesh].indices.size() / 3;
    const Drawn drawn = shown(options, std::move(picture.radiance));
    if (target) {
        PELLUCID_TRY(report.comparison, compare(options, drawn, *target));
    }
    char text[160];
    std::snprintf(text, sizeof text, "reference on the CPU: %ux%u, %.1f ms", options.settings.size.width,
                  options.settings.size.height, took.count());
    return finish(options, drawn, {}, report, text);
}
