// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The viewer without a window: some frames, then whatever still takes time (reference pictures, measurements), then
/// the last frame.
#include "start.hpp"
#include <thread>

namespace pellucid::samples::viewer {

/// Errors: a scene that cannot be read, a setting that cannot be had (nobody is there to read it in a panel), and
/// everything that ends a frame.
template <rhi::Backend B>
[[nodiscard]] Result<void> run_headless(const Options& options, State& state, const rhi::DeviceDesc& desc) {
    StartTimes times;
    PELLUCID_TRY(Loaded loaded, load_scene(options.scene));
    times.load = loaded.ms;
    state.show(std::move(loaded), layout_of(options.size, options.choices.hide_ui).picture_size());
    Guarded<B> viewer(desc, state);
    const Input input{.seconds = 1};  // the camera rests
    PELLUCID_CHECK(first_frame(viewer, input, options.size, desc.pipeline_cache, times));
    print(times, desc.pipeline_cache);
    const auto go_on = [&]() -> Result<void> {
        PELLUCID_CHECK(viewer.frame(input, options.size));
        if (!state.facts.left.problem.empty()) return Error{Errc::invalid_argument, state.facts.left.problem};
        if (!state.facts.right.problem.empty()) return Error{Errc::invalid_argument, state.facts.right.problem};
        return {};
    };
    const auto finish = [&]() -> Result<void> {
        while (state.busy() || viewer.session().measuring()) {
            if (!viewer.session().measuring()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            PELLUCID_CHECK(go_on());
        }
        return {};
    };
    for (std::uint32_t i = 1; i < options.frames; ++i) PELLUCID_CHECK(go_on());
    PELLUCID_CHECK(finish());
    if (options.measure) {
        state.requests.measure = state.requests.measure_all = true;
        PELLUCID_CHECK(go_on());
        PELLUCID_CHECK(finish());
    }
    if (options.frames > 1 || options.measure) PELLUCID_CHECK(go_on());  // with everything that is known by now
    if (options.screenshot.empty()) return {};
    return write_screenshot(viewer.session(), options.screenshot);
}

}  // namespace pellucid::samples::viewer
