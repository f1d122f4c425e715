// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the program says and writes in the end: pictures by their file's ending, and the statistics.
#include "compare.hpp"
#include "options.hpp"
#include "translucency.hpp"
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/statistics.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/camera.hpp>
#include <string>
#include <vector>

/// A file that a run writes, and the endings that say how.
struct OutputFile {
    std::string file;
    std::vector<std::string> endings;
};
std::vector<OutputFile> output_files(const Options& options);
/// That `file` has an ending we write and lies in a folder we can write to.  Errors: `invalid_argument`, `io`.
pellucid::Result<void> check_writable(const OutputFile& file);
/// The camera that --camera asks for, else the scene's first, else one that frames the scene.
pellucid::Result<pellucid::Camera> choose_camera(const pellucid::Scene& scene, const Options& options);

/// One pass's GPU times [ms] over the run.
struct PassTime {
    std::string name;
    pellucid::measure::Summary ms;
};
struct Report {
    const pellucid::rhi::DeviceInfo* device = nullptr;  ///< null: the reference renderer drew
    pellucid::RenderStats stats;
    std::vector<PassTime> pass_times;
    /// Wall clock round submit and wait; the first frame is left out if it can be.
    pellucid::measure::Summary frame_ms;
    double load_to_first_frame_ms = 0;
    TranslucencyReport translucency;
    std::optional<Comparison> comparison;
};

/// A channel of the G-buffer to be written, and where.
struct Channel {
    std::string file;
    pellucid::ImageF values;  ///< [h, w, 3]
};

/// The end of a run: says what there is to say (`text`: what was drawn and how long it took) and writes every file.
/// Pictures: .png is what a display shows, .pfm and .exr are linear.  Channels: .png shows them limited to [0,1].
/// \returns the exit status of the contract.  Errors: io.
pellucid::Result<int> finish(const Options& options, const Drawn& drawn, const std::vector<Channel>& channels,
                             Report& report, const std::string& text);
