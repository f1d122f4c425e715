// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// --reference and --compare reference: the same scene by the reference renderer, on the CPU.
#include "compare.hpp"
#include "options.hpp"
#include <pellucid/reference/renderer.hpp>
#include <pellucid/scene/scene.hpp>

/// Draws what the options ask a device for: size, background, lights, reflectance.  `stability`: also
/// Picture::stable.  Shows how far it is on stderr, if that is a terminal.  Errors: those of reference::render.
pellucid::Result<pellucid::reference::Picture> draw_reference(const Options& options, const pellucid::Scene& scene,
                                                              const pellucid::Camera& camera, bool stability);

/// The picture as a display shows it: exposure, tone map and sRGB curve in double.
Drawn shown(const Options& options, pellucid::ImageF radiance);

/// The whole run of --reference.  \returns the exit status of a run that worked.
pellucid::Result<int> run_reference(const Options& options, const pellucid::Scene& scene,
                                    const pellucid::Camera& camera, const std::optional<Target>& target);
