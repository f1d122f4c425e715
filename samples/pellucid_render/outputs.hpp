// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the program writes: pictures by their file's ending, and the statistics.
#include "compare.hpp"
#include "options.hpp"
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/statistics.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/camera.hpp>
#include <string>
#include <vector>

/// Every file that a run with `options` writes.
std::vector<std::string> output_files(const Options& options);
/// That `file` has an ending we write and lies in a folder we can write to.  Errors: `invalid_argument`, `io`.
pellucid::Result<void> check_writable(const std::string& file);
/// The camera that --camera asks for, else the scene's first, else one that frames the scene.
pellucid::Result<pellucid::Camera> choose_camera(const pellucid::Scene& scene, const Options& options);

/// `.png` writes `display` ([h,w,4] sRGB codes, alpha dropped), `.pfm` and `.exr` write `linear` ([h,w,3..4]).
pellucid::Result<void> write_picture(const std::string& file, const pellucid::ImageF& linear,
                                     const pellucid::Image8& display);
/// A float picture that is not a photograph (an AOV): .png shows it clamped to [0,1].
pellucid::Result<void> write_values(const std::string& file, const pellucid::ImageF& values);

/// One pass's GPU times [ms] over the run.
struct PassTime {
    std::string name;
    pellucid::measure::Summary ms;
};
struct Report {
    const pellucid::rhi::DeviceInfo* device = nullptr;
    pellucid::RenderStats stats;
    std::vector<PassTime> pass_times;
    pellucid::measure::Summary
        frame_ms;  ///< wall clock round submit and wait; the first frame is left out if it can be
    double load_to_first_frame_ms = 0;
    std::optional<Comparison> comparison;
};
pellucid::Result<void> write_stats(const std::string& file, const Options& options, const Report& report);
