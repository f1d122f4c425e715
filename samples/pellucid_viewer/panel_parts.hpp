// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Parts of the panel, a file each.
#include "panel.hpp"

namespace pellucid::samples::viewer {

void settings_tab(const Facts& facts, Choices& choices, Requests& requests);
void time_tab(const Facts& facts);
void error_tab(const Facts& facts, Choices& choices, Requests& requests);
/// Over the picture: the split with the names of its sides, the legend, and how far long computations are.
void overlay(const Layout& layout, const Facts& facts, const Choices& choices, Requests& requests);

/// Time against error on logarithmic axes, as wide as the window; the point under the pointer says what it is.
void scatter_plot(const Points& points, float height);

}  // namespace pellucid::samples::viewer
