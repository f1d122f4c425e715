// SPDX-License-Identifier: MIT
// Bindings of interleaved translucency as SkyXEngine has it, and what its pixels say of their surface.
#ifndef PELLUCID_GPU_INTERLEAVED_SKYX_H
#define PELLUCID_GPU_INTERLEAVED_SKYX_H
#include "pellucid/gpu/types.h"

#define PELLUCID_SKYX_LIGHT 12  // sampled, rgba16_float: radiance of every pixel's surface, opaque or not
#define PELLUCID_SKYX_DEPTH 13  // sampled: depth of every pixel's surface, d32_float or r32_float
#define PELLUCID_SKYX_INFO 14   // sampled, r32_uint: id8 | alpha16 << 8 | PELLUCID_SKYX_TRANSLUCENT

#define PELLUCID_SKYX_TRANSLUCENT 0x80000000u
#define PELLUCID_SKYX_NOTHING 0u     // id of a pixel without a surface
#define PELLUCID_SKYX_OPAQUE 1u      // id of what is opaque
#define PELLUCID_SKYX_IDS 126u       // translucent surfaces count from 2 and start again
#define PELLUCID_SKYX_LEAST_ALPHA 8  // [1/255] less is not drawn

PELLUCID_GPU_BEGIN
/// Push data of the marks.
struct SkyxMark {
    uvec4 parity;  // column and row of the pixels that are marked, 0 or 1
};
PELLUCID_GPU_SIZE(SkyxMark, 16)
PELLUCID_GPU_END
#endif
