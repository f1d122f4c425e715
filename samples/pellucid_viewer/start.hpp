// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What comes before the first frame, and the line that says how long it took.
#include "../support/environment_file.hpp"
#include "guarded.hpp"
#include "options.hpp"
#include <pellucid/rhi/desc.hpp>
#include <cstdio>
#include <filesystem>

namespace pellucid::samples::viewer {

[[nodiscard]] inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// [ms] by part; all but `all` are parts of it.
struct StartTimes {
    std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
    double load = 0, device = 0, renderer = 0, frame = 0;
    const char* cache = "none";  ///< read, new or none
};

/// Chooses what was asked for, and reads the environment's picture.  Errors: io, parse.
[[nodiscard]] inline Result<void> prepare(const Options& options, State& state) {
    state.choices = options.choices;
    if (options.environment.empty()) return {};
    PELLUCID_TRY(state.choices.render.environment.picture, read_environment(options.environment));
    state.choices.render.environment.kind = EnvironmentKind::picture;
    return {};
}

/// Where the pipelines of a backend are kept: the file asked for; that of a backend that was switched to beside it.
[[nodiscard]] inline std::string cache_file(const Options& options, const char* backend, bool switched) {
    return options.pipeline_cache.empty() || !switched ? options.pipeline_cache
                                                       : options.pipeline_cache + "." + backend;
}

/// Starts the device and draws the first frame.  Errors: those of both.
template <rhi::Backend B>
[[nodiscard]] Result<bool> first_frame(Guarded<B>& viewer, const Input& input, Extent2D canvas,
                                       const std::string& cache, StartTimes& times) {
    if (!cache.empty()) times.cache = std::filesystem::exists(cache) ? "read" : "new";
    auto from = std::chrono::steady_clock::now();
    PELLUCID_CHECK(viewer.start());
    times.device = milliseconds_since(from);
    from = std::chrono::steady_clock::now();
    PELLUCID_TRY(const bool drawn, viewer.frame(input, canvas));
    times.renderer = viewer.session().build_ms();
    times.frame = milliseconds_since(from) - times.renderer;
    return drawn;
}
inline void print(const StartTimes& t, const std::string& cache) {
    std::printf(
        "pellucid-viewer: first frame after %.0f ms (load %.0f, device %.0f, renderer %.0f, frame %.0f; pipeline "
        "cache%s%s: %s)\n",
        milliseconds_since(t.begun), t.load, t.device, t.renderer, t.frame, cache.empty() ? "" : " ", cache.c_str(),
        t.cache);
    std::fflush(stdout);
}

/// Writes what --screenshot asks for.  Errors: io, device loss.
template <rhi::Backend B>
[[nodiscard]] Result<void> write_screenshot(Session<B>& session, const std::string& file) {
    if (file.ends_with(".exr")) {
        PELLUCID_TRY(const ImageF radiance, session.read_radiance());
        return write_exr(file, radiance);
    }
    PELLUCID_TRY(const Image8 canvas, session.read_canvas());
    return write_png(file, canvas);
}

}  // namespace pellucid::samples::viewer
