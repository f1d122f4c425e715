// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// --compare, --mask and --heatmap.
#include "options.hpp"
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/measure/coverage.hpp>
#include <pellucid/measure/heat_map.hpp>
#include <optional>
#include <string>

/// A picture of this run.
struct Drawn {
    pellucid::ImageF linear;   ///< [h, w, 3] or [h, w, 4] radiance before the tone map
    pellucid::Image8 display;  ///< [h, w, 4] sRGB codes
};

/// What a picture of this run is compared with.
struct Target {
    std::string name;                      ///< the file, or what else it is
    bool display = false;                  ///< `picture` is display-referred: signals in [0,1]
    pellucid::ImageF picture;              ///< [h, w, 3]
    std::optional<pellucid::Image8> mask;  ///< [h, w, 1]: 255 where pixels are compared, the others apart
    const pellucid::measure::LayerCounts* layers = nullptr;       ///< of the target, or null
    const pellucid::measure::LayerCounts* test_layers = nullptr;  ///< of this run, or null
};

/// What a comparison found.
struct Comparison {
    double rmse = 0;                                     ///< of linear values, or of display signals
    bool within_budget = true;                           ///< --error-budget, if there is one
    std::string text;                                    ///< one line for a person
    std::string json;                                    ///< one object: measure/quality.hpp, and what was compared
    std::optional<pellucid::measure::HeatMap> heat_map;  ///< for --heatmap
};

/// Reads what --compare and --mask name, before anything is drawn; nothing where there is no --compare.  With
/// --compare reference the picture is still to be filled in.  Errors: io, parse; invalid_argument where a size differs
/// from the picture's.
pellucid::Result<std::optional<Target>> read_target(const Options& options);

/// Compares by every metric of measure/quality.hpp.  Errors: those of `quality`.
pellucid::Result<Comparison> compare(const Options& options, const Drawn& drawn, const Target& target);
