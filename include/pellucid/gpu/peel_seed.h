// SPDX-License-Identifier: MIT
// Bindings and constants of depth peeling as the document the project grew from has it.
#ifndef PELLUCID_GPU_PEEL_SEED_H
#define PELLUCID_GPU_PEEL_SEED_H
#include "pellucid/gpu/types.h"

#define PELLUCID_PEEL_SEED_PREVIOUS 12   // sampled, d32_float: depth of the last layer
#define PELLUCID_PEEL_SEED_OPAQUE 13     // sampled, d32_float: what is opaque
#define PELLUCID_PEEL_SEED_LAYERS 6      // how many, unless asked otherwise
#define PELLUCID_PEEL_SEED_EPSILON 1e-4  // depth by which a fragment must be behind the last layer
#endif
