// SPDX-License-Identifier: MIT
#pragma once
#include "../support/exit_status.hpp"
#include "choices.hpp"
#include <optional>
#include <string>
#include <utility>

namespace pellucid::samples::viewer {

/// What the command line asked for.
struct Options {
    std::string scene;  ///< empty: the demo scene
    std::string backend = "auto";
    std::string device;
    Extent2D size{1280, 720};  ///< of the canvas
    Choices choices;
    std::string environment;  ///< file of its picture
    bool headless = false;
    std::uint32_t frames = 0;  ///< 0: until the window is closed; without one: 4
    bool measure = false;      ///< every method, before the last frame
    std::string screenshot;    ///< .png: the canvas; .exr: linear radiance of the left picture
    std::string pipeline_cache;
    bool vsync = true;
    bool validate = false;
};

/// Parses the command line.  Returns the exit status instead where the program is already done (--help, bad usage);
/// what there is to say has been said.
std::pair<Options, std::optional<int>> parse_options(int argc, char** argv);

}  // namespace pellucid::samples::viewer
