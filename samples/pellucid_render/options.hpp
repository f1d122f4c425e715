// SPDX-License-Identifier: MIT
#pragma once
#include <pellucid/core/result.hpp>
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

/// Exit statuses of the command-line contract; `failed`: a driver, the validation layer or this program is at fault.
enum class Exit : int { done = 0, failed = 1, usage = 2, input = 3, no_device = 4, device = 5, error_budget = 6 };

/// The exit status of a run that ended with this error.
[[nodiscard]] inline Exit exit_status(pellucid::Errc error) {
    using pellucid::Errc;
    switch (error) {
        case Errc::invalid_argument:
            return Exit::usage;
        case Errc::no_device:
        case Errc::unsupported:
            return Exit::no_device;
        case Errc::device_lost:
        case Errc::out_of_memory:
            return Exit::device;
        case Errc::internal:
            return Exit::failed;
        default:
            return Exit::input;
    }
}

/// Parses the command line.  Returns the exit status instead where the program is already done (--help, bad usage);
/// what there is to say has been said.
std::pair<Options, std::optional<int>> parse_options(int argc, char** argv);
