// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Small services for pictures that need no device.
#include <pellucid/renderer/settings.hpp>
#include <string>

namespace pellucid::samples::viewer {

/// `[h, w, 4]` codes of linear radiance, by the settings' exposure and tone curve.
[[nodiscard]] Image8 tone_mapped(const RenderSettings& settings, const ImageF& radiance);

/// "pellucid-viewer-1.png" in the working directory, or the next number that no file has.
[[nodiscard]] std::string free_file_name(const char* ending);

}  // namespace pellucid::samples::viewer
