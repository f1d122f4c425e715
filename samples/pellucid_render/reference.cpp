// SPDX-License-Identifier: MIT
#include "reference.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include <pellucid/reference/srgb.hpp>
#include <pellucid/reference/tonemap.hpp>
#include <pellucid/renderer/needs.hpp>
#include <chrono>
#include <cstdio>

using namespace pellucid;

#if defined(PELLUCID_HAS_REFERENCE)

Result<reference::Picture> draw_reference(const Options& options, const Scene& scene, const Camera& camera,
                                          bool stability) {
    const RenderSettings& s = options.settings;
    ProgressBar bar("reference");
    reference::RenderOptions how{.size = s.size,
                                 .background = glm::dvec3(s.background),
                                 .lights = scene.lights,
                                 .brdf = static_cast<reference::BrdfModel>(s.brdf),  // the same names in one order
                                 .environment = s.environment,
                                 .shadows = s.shadows != Shadows::none,
                                 .translucent = s.transparency != Transparency::none,
                                 .stability = stability,
                                 .progress = &ProgressBar::show,
                                 .user = &bar};
    if (gets_default_sun(scene, s)) {
        how.lights.push_back(default_sun());
        if (s.environment.kind == EnvironmentKind::none) how.ambient = glm::dvec3(static_cast<double>(default_ambient));
    }
    return reference::render(scene, camera, how);
}

#else

Result<reference::Picture> draw_reference(const Options&, const Scene&, const Camera&, bool) {
    return Error{Errc::invalid_argument, "this program was built without the reference renderer"};
}

#endif

Drawn shown(const Options& options, ImageF radiance) {
    const RenderSettings& s = options.settings;
    const auto curve = s.tonemap == ToneCurve::none       ? reference::ToneMap::none
                       : s.tonemap == ToneCurve::reinhard ? reference::ToneMap::reinhard
                       : s.tonemap == ToneCurve::neutral  ? reference::ToneMap::neutral
                       : s.tonemap == ToneCurve::aces     ? reference::ToneMap::aces
                                                          : reference::ToneMap::agx;
    Drawn out{.linear = std::move(radiance), .display = Image8(s.size.width, s.size.height, 4)};
    for (std::size_t i = 0; i < out.display.data.size() / 4; ++i) {
        const float* const from = &out.linear.data[i * out.linear.channels];
        const glm::dvec3 mapped =
            reference::tone_map(curve, static_cast<double>(s.exposure_ev), glm::dvec3(from[0], from[1], from[2]));
        for (int c = 0; c < 3; ++c)
            out.display.data[4 * i + static_cast<std::size_t>(c)] = reference::srgb8_from_linear(mapped[c]);
        out.display.data[4 * i + 3] = 255;
    }
    return out;
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
