// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One run on one backend: render, read back, compare, write.
#include "aov.hpp"
#include "compare.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include <pellucid/measure/statistics.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <chrono>
#include <cstdio>
#include <map>

/// Counts driver and validation messages, and passes them on to stderr.
struct MessageCount {
    unsigned errors = 0;
    static void write(void* user, pellucid::Severity severity, const char* text) {
        if (severity != pellucid::Severity::info) ++static_cast<MessageCount*>(user)->errors;
        std::fprintf(stderr, "pellucid-render: device: %s\n", text);
    }
};

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

/// \returns the exit status of a run that worked.
template <pellucid::rhi::Backend B>
pellucid::Result<int> run(const Options& options, const pellucid::Scene& scene, const pellucid::Camera& camera) {
    using namespace pellucid;
    MessageCount messages;
    Report report;
    bool over_budget = false;
    {
        const auto start = std::chrono::steady_clock::now();
        std::unique_ptr<typename B::Device> device;
        PELLUCID_TRY(device, B::create({.device = options.device,
                                        .validation = options.validate,
                                        .gl_spirv = options.gl_spirv,
                                        .pipeline_cache = options.pipeline_cache,
                                        .log = {&MessageCount::write, &messages}}));
        report.device = &device->info();
        std::unique_ptr<Renderer<B>> renderer;
        PELLUCID_TRY(renderer, Renderer<B>::create(*device, scene, options.settings));
        report.load_to_first_frame_ms = milliseconds_since(start);
        PELLUCID_CHECK(draw_frames<B>(*device, *renderer, camera, options, report));
        report.stats = renderer->stats();
        for (const std::string& warning : report.stats.warnings)
            std::fprintf(stderr, "pellucid-render: warning: %s\n", warning.c_str());
        ImageF linear;
        Image8 display;
        PELLUCID_TRY(linear, renderer->read_hdr());
        PELLUCID_TRY(display, renderer->read_display());
        if (!options.out.empty()) PELLUCID_CHECK(write_picture(options.out, linear, display));
        for (const auto& [name, file] : options.aovs) {
            ImageF values;
            PELLUCID_TRY(values, read_aov<B>(*renderer, camera, name));
            PELLUCID_CHECK(write_values(file, values));
        }
        if (!options.compare.empty()) {
            PELLUCID_TRY(report.comparison, compare(options, linear, display));
            over_budget = options.error_budget && !(report.comparison->rmse <= *options.error_budget);
        }
        if (!options.stats.empty()) PELLUCID_CHECK(write_stats(options.stats, options, report));
        std::printf("%s on %s: %ux%u, %u draws, %.2f ms a frame%s%s\n", B::name, device->info().name.c_str(),
                    options.settings.size.width, options.settings.size.height, report.stats.draws,
                    report.frame_ms.median, options.out.empty() ? "" : ", ", options.out.c_str());
    }
    if (options.validate && messages.errors != 0)
        return Error{Errc::internal, std::to_string(messages.errors) + " validation messages"};
    return static_cast<int>(over_budget ? Exit::error_budget : Exit::done);
}
