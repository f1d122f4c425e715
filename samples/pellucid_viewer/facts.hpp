// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the session tells the panel, and what the panel asks of the session besides settings.
#include "heat.hpp"
#include "history.hpp"
#include "jobs.hpp"
#include "layout.hpp"
#include "points.hpp"
#include <pellucid/renderer/renderer.hpp>
#include <optional>
#include <string>
#include <vector>

namespace pellucid::samples::viewer {

/// One of the two pictures.
struct SideFacts {
    bool drawn = false;
    std::string label;    ///< the settings that drew it
    std::string problem;  ///< why it is not what was asked for; empty where it is
    RenderStats stats;
};

struct Progress {
    std::string what;
    double fraction = -1;  ///< below 0: nobody knows
};

struct Facts {
    rhi::DeviceInfo device;
    std::vector<std::string> backends;     ///< that the viewer can switch to; empty without a window
    std::vector<std::string> unavailable;  ///< in the order of all_transparencies: why not, or empty
    std::string scene;
    std::vector<std::string> cameras;
    std::size_t camera = 0;
    SideFacts left, right;
    FrameHistory history;
    Legend legend;
    std::optional<Quality> quality;
    bool quality_is_old = false;  ///< the camera or the settings have changed since
    Points points;
    std::string message;  ///< the last thing that went wrong, or was done
    bool message_is_error = false;
    std::optional<Progress> loading, reference, judging, measuring;
    bool reference_is_old = false;  ///< there is a reference picture, of another camera or other settings
    double first_frame_ms = 0;
};

struct Requests {
    bool screenshot_png = false, picture_png = false, picture_exr = false;
    bool measure = false, measure_all = false;
    bool draw_reference = false, cancel_reference = false;
    std::optional<std::size_t> camera;
    std::optional<std::string> backend;  ///< another one
};

}  // namespace pellucid::samples::viewer
