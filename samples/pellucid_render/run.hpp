// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One run on one backend: render, read back, compare, write.
#include "../support/messages.hpp"
#include "aov.hpp"
#include "compare.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "reference.hpp"
#include <pellucid/measure/statistics.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <utility>

inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Draws options.frames frames and fills in the timings.
template <pellucid::rhi::Backend B>
pellucid::Result<void> draw_frames(typename B::Device& device, pellucid::Renderer<B>& renderer,
                                   const pellucid::Camera& camera, const Options& options, Report& report) {
    using namespace pellucid;
    std::map<std::string, std::vector<double>> times;
    std::vector<double> frames;
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, renderer.render(camera));
        PELLUCID_CHECK(device.wait(ticket));
        frames.push_back(milliseconds_since(start));
        std::span<const measure::GpuSpan> spans;
        PELLUCID_TRY(spans, renderer.gpu_times());
        for (const measure::GpuSpan& span : spans) times[span.name].push_back(span.ms);
    }
    report.load_to_first_frame_ms += frames.front();
    if (frames.size() > 1) frames.erase(frames.begin());  // the first one warms caches
    report.frame_ms = measure::summarize(frames);
    for (auto& [pass, values] : times) report.pass_times.push_back({pass, measure::summarize(values)});
    return {};
}

/// What the renderer tells about its last frame's transparency, and what the options ask about it.  `counts`: filled in
/// where layers had to be counted, which takes a frame, and this device can count.
template <pellucid::rhi::Backend B>
pellucid::Result<void> ask_about_translucency(const Options& options, const pellucid::Scene& scene,
                                              const pellucid::Camera& camera, pellucid::Renderer<B>& renderer,
                                              Report& report, pellucid::measure::LayerCounts& counts) {
    using namespace pellucid;
    const RenderSettings& settings = options.settings;
    TranslucencyReport& out = report.translucency;
    out = report_translucency(options, scene, camera, report.stats.translucency);
    const bool left_out = report.stats.translucency.truncated || settings.min_transmittance > 0;
    if (left_out && traits(settings.transparency).min_transmittance) {
        PELLUCID_TRY(out.transmittance_left, renderer.read_transmittance_left());
    }
    measure::LayerCounts composited;
    if (settings.audit && report.stats.translucency.ran) {
        PELLUCID_TRY(composited, renderer.read_composited());
    }
    if (report.device->float32_blending && (settings.audit || !options.stats.empty() || options.against_reference())) {
        PELLUCID_TRY(counts, renderer.count_layers());
    }
    if (!options.stats.empty() && !counts.empty()) out.layers = summarize_layers(counts);
    if (settings.audit) {
        PELLUCID_TRY(out.audit, measure::layer_difference(composited.empty() ? counts : composited, counts));
    }
    return {};
}

/// --compare: with a file, or with what the reference renderer draws.
template <pellucid::rhi::Backend B>
pellucid::Result<void> compare_frame(const Options& options, const pellucid::Scene& scene,
                                     const pellucid::Camera& camera, const Drawn& drawn,
                                     const pellucid::measure::LayerCounts& counts, Target target, Report& report) {
    using namespace pellucid;
    reference::Picture picture;
    if (options.against_reference()) {
        PELLUCID_TRY(picture, draw_reference(options, scene, camera, !target.mask));
        target.picture = std::move(picture.radiance);
        if (!target.mask) target.mask = std::move(picture.stable);
        if (!counts.empty()) {
            target.test_layers = &counts;
            target.layers = &picture.layers;
        }
    }
    PELLUCID_TRY(report.comparison, compare(options, drawn, target));
    return {};
}

/// \returns the exit status of a run that worked.
template <pellucid::rhi::Backend B>
pellucid::Result<int> run(const Options& options, const pellucid::Scene& scene, const pellucid::Camera& camera,
                          const std::optional<Target>& target) {
    using namespace pellucid;
    samples::Messages messages{.program = "pellucid-render"};
    Report report;
    int status = 0;
    {
        const auto start = std::chrono::steady_clock::now();
        std::unique_ptr<typename B::Device> device;
        PELLUCID_TRY(device, B::create({.device = options.device,
                                        .validation = options.validate,
                                        .gl_spirv = options.gl_spirv,
                                        .pipeline_cache = options.pipeline_cache,
                                        .log = messages.sink()}));
        report.device = &device->info();
        std::unique_ptr<Renderer<B>> renderer;
        PELLUCID_TRY(renderer, Renderer<B>::create(*device, scene, options.settings));
        report.load_to_first_frame_ms = milliseconds_since(start);
        PELLUCID_CHECK(draw_frames<B>(*device, *renderer, camera, options, report));
        report.stats = renderer->stats();
        Drawn drawn;
        PELLUCID_TRY(drawn.linear, renderer->read_hdr());
        PELLUCID_TRY(drawn.display, renderer->read_display());
        std::vector<Channel> channels;
        for (const auto& [name, file] : options.aovs) {
            PELLUCID_TRY(ImageF values, read_aov<B>(*renderer, camera, name));
            channels.push_back({file, std::move(values)});
        }
        measure::LayerCounts counts;
        PELLUCID_CHECK(ask_about_translucency<B>(options, scene, camera, *renderer, report, counts));
        if (target) PELLUCID_CHECK(compare_frame<B>(options, scene, camera, drawn, counts, *target, report));
        char text[320];
        std::snprintf(text, sizeof text, "%s on %s: %ux%u, %u draws, transparency %s, %.2f ms a frame", B::name,
                      device->info().name.c_str(), options.settings.size.width, options.settings.size.height,
                      report.stats.draws, name(options.settings.transparency), report.frame_ms.median);
        PELLUCID_TRY(status, finish(options, drawn, channels, report, text));
    }
    if (options.validate && messages.errors != 0)
        return Error{Errc::internal, std::to_string(messages.errors) + " validation messages"};
    return status;
}
