// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a person did since the last frame.  A window fills it in, or a test.
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::samples::viewer {

struct Input {
    double seconds = 1.0 / 60;  ///< since the last frame
    float x = -1, y = -1;       ///< [pixel] of the pointer, from the canvas' top left; outside where there is none
    bool left = false, right = false, middle = false;  ///< buttons that are held
    float wheel = 0;                                   ///< steps, away from the person
    /// Keys that are held, in [-1,1] each way.
    double move_right = 0, move_up = 0, move_forward = 0;
    bool fast = false;       ///< a key that makes walking faster is held
    bool toggle_ui = false;  ///< keys that were pressed
    bool screenshot = false;
    std::vector<std::string> dropped;  ///< files
};

}  // namespace pellucid::samples::viewer
