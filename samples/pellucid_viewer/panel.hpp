// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The panel: plain data in, choices and requests out.  It knows no device, so it is compiled once.
#include "choices.hpp"
#include "facts.hpp"
#include "layout.hpp"

namespace pellucid::samples::viewer {

/// Lays out everything that is drawn over the picture or beside it.  Between Ui::begin and Ui::end.
void draw_panel(const Layout& layout, const Facts& facts, Choices& choices, Requests& requests);

}  // namespace pellucid::samples::viewer
