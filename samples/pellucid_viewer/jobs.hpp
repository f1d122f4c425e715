// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the viewer computes beside the frames: reading files, reference pictures, measured errors.
#include "choices.hpp"
#include "task.hpp"
#include <pellucid/measure/image_error.hpp>
#include <pellucid/scene/scene.hpp>
#include <memory>
#include <string>

namespace pellucid::samples::viewer {

/// A scene, and where it comes from.
struct Loaded {
    std::shared_ptr<const Scene> scene;
    std::string name;
    double ms = 0;  ///< [ms] that reading it took
};
/// Reads a glTF file; an empty name is the demo scene.  Errors: io, parse.
[[nodiscard]] Result<Loaded> load_scene(const std::string& file);

/// What the reference renderer drew: for these settings (their size is the picture's own) and this camera.
struct ReferencePicture {
    RenderSettings settings;
    Camera camera;
    std::shared_ptr<const Scene> scene;
    ImageF radiance;  ///< [h, w, 3]
};
/// Draws it; `control.stop` ends it with `invalid_argument`.  Errors: those of the reference renderer; `unsupported`
/// where the program was built without it.
[[nodiscard]] Result<ReferencePicture> draw_reference(std::shared_ptr<const Scene> scene, const Camera& camera,
                                                      const RenderSettings& settings, TaskControl& control);
[[nodiscard]] bool has_reference();

/// How far one picture is from another: linear radiance (absolute errors), the display's (PSNR), and the eye's (FLIP).
struct Quality {
    std::string test, truth;  ///< names
    double rmse = 0, max = 0;
    double psnr = 0;              ///< [dB] of tone-mapped signals
    double flip = 0;              ///< mean
    std::uint64_t different = 0;  ///< pixels with another bit
    std::uint64_t nonfinite = 0;  ///< values
};
/// Both `[h, w, 3]`.  Errors: those of `measure::quality`.
[[nodiscard]] Result<Quality> judge(const ImageF& test, const ImageF& truth);

/// The first three channels.
[[nodiscard]] ImageF rgb(const ImageF& picture);

}  // namespace pellucid::samples::viewer
