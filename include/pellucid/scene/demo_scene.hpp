// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The scene of the project's own pictures: needs no file.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/scene.hpp>

namespace pellucid::inline v0_1 {

/// 5 x 5 spheres, metallic 0 to 1 from the bottom row to the top one, roughness 0.05 to 1 from left to right, over a
/// floor with a wall behind; eight coloured point lights; two translucent cubes (alpha 0.4 and 0.6) that overlap each
/// other and the spheres behind them on the screen; one perspective camera for pictures of 16:9.
[[nodiscard]] Scene make_demo_scene();

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/demo_scene-inl.hpp>
#endif
