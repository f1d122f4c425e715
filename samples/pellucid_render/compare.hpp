// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// --compare, --mask and --heatmap.
#include "options.hpp"
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <string>

/// What a comparison found, in the definitions of measure/image_error.hpp.
struct Comparison {
    double rmse = 0;   ///< of linear values (.pfm), or of display values in [0,1] (.png)
    std::string text;  ///< one line for a person
    std::string json;  ///< one object
};

/// Compares this run's picture ([h,w,4] both) with the file that --compare names, prints the result, and writes the
/// heat map if one is asked for.  Errors: io, parse, or invalid_argument where the sizes differ.
pellucid::Result<Comparison> compare(const Options& options, const pellucid::ImageF& linear,
                                     const pellucid::Image8& display);
