// SPDX-License-Identifier: MIT
// Bindings of dual depth peeling.
#ifndef PELLUCID_GPU_DUAL_PEEL_H
#define PELLUCID_GPU_DUAL_PEEL_H
#include "pellucid/gpu/types.h"

// Depths of the nearest and the farthest fragment left, as (z, -z); both -2 where none is.
#define PELLUCID_DUAL_PEEL_RANGE 12  // sampled, rg32_float: of the last pass
#define PELLUCID_DUAL_PEEL_FRONT 13  // sampled, rgba32_float: of the last pass: colour, 1 - what gets through
#define PELLUCID_DUAL_PEEL_BACK 14   // sampled, rgba32_float: a back layer, or the sum of all with what gets through
#define PELLUCID_DUAL_PEEL_NONE -2.0
#endif
