// SPDX-License-Identifier: MIT
#pragma once
#include "../support/window.hpp"
#include "input.hpp"

namespace pellucid::samples::viewer {

/// What the window's last poll or wait took in, and what is held now.
[[nodiscard]] Input input_of(const Window& window, double seconds);

}  // namespace pellucid::samples::viewer
