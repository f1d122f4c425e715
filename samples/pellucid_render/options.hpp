// SPDX-License-Identifier: MIT
#pragma once
#include "../support/exit_status.hpp"
#include <pellucid/renderer/settings.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What the command line asked for.
struct Options {
    std::string scene;
    std::string backend = "auto";
    std::string device;
    bool list_devices = false;
    std::string camera;  ///< index or name; empty: the scene's first, else one that frames the scene
    pellucid::RenderSettings settings;
    std::string environment;          ///< file of the environment's picture, to be read into the settings
    bool chose_transparency = false;  ///< false: --transparency auto
    bool reference = false;           ///< draw on the CPU, in double, instead of on a device
    std::string out;
    std::vector<std::pair<std::string, std::string>> aovs;  ///< name, file
    std::string stats;
    std::uint32_t frames = 1;
    std::string compare;  ///< file of a picture to compare with, or "reference": the one that the CPU draws
    std::string mask;     ///< picture of where to compare
    std::string heatmap;
    std::optional<double> error_budget;
    bool validate = false;
    bool gl_spirv = false;
    std::string pipeline_cache;

    [[nodiscard]] bool against_reference() const { return compare == "reference"; }
};

using pellucid::samples::Exit;
using pellucid::samples::exit_status;

/// Parses the command line.  Returns the exit status instead where the program is already done (--help, bad usage);
/// what there is to say has been said.
std::pair<Options, std::optional<int>> parse_options(int argc, char** argv);
