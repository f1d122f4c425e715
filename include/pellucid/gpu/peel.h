// SPDX-License-Identifier: MIT
// Bindings of depth peeling.
#ifndef PELLUCID_GPU_PEEL_H
#define PELLUCID_GPU_PEEL_H
#include "pellucid/gpu/types.h"

#define PELLUCID_PEEL_NEXT 12    // sampled, r32_float: depth of the nearest fragments behind the last layer; -1: none
#define PELLUCID_PEEL_OPAQUE 13  // sampled, d32_float: what is opaque
#define PELLUCID_PEEL_SUM 14     // sampled, rgba32_float: what is composited; alpha: the share that gets through

PELLUCID_GPU_BEGIN
/// Push data of the advance.
struct PeelAdvance {
    float min_transmittance;  // a pixel is done where no more gets through; below 0: never
    uint reserved0;
    uint reserved1;
    uint reserved2;
};
PELLUCID_GPU_SIZE(PeelAdvance, 16)
PELLUCID_GPU_END
#endif
