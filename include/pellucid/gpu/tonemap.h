// SPDX-License-Identifier: MIT
// Tone-mapping curves and the bindings of the pass.
#ifndef PELLUCID_GPU_TONEMAP_H
#define PELLUCID_GPU_TONEMAP_H
#include "pellucid/gpu/types.h"

#define PELLUCID_TONEMAP_NONE 0u
#define PELLUCID_TONEMAP_REINHARD 1u
#define PELLUCID_TONEMAP_NEUTRAL 2u
#define PELLUCID_TONEMAP_ACES 3u
#define PELLUCID_TONEMAP_AGX 4u

#define PELLUCID_TONEMAP_OUTPUT 0       // storage image, rgba8: display-referred, sRGB-encoded
#define PELLUCID_TONEMAP_INPUT 12       // sampled, rgba16_float: linear radiance
#define PELLUCID_TONEMAP_GROUP_SIZE 16  // workgroup edge [pixel]: starting smaller groups takes longer than their work
#endif
