// SPDX-License-Identifier: MIT
// The G-buffer's layouts, as C++ allocates them and shaders read and write them.
//
// compact, 16 bytes a pixel with depth:            classic, 36 bytes a pixel with depth (kept to be measured):
//   0  r32_uint    octahedral normal, 2 × snorm16    0  rgba32_float  world position
//   1  rgba8_srgb  base colour, occlusion            1  rgba16_float  normal
//   2  r32_uint    roughness16|metallic8|flags8      2  rgba8_srgb    base colour
//   depth d32_float                                  3  rgba8_unorm   metallic, roughness, occlusion, flags
// Both add one rgba16_float target for emitted radiance where the scene needs it.  A pixel is covered where depth != 0.
#ifndef PELLUCID_GPU_GBUFFER_H
#define PELLUCID_GPU_GBUFFER_H
#include "pellucid/gpu/types.h"

#define PELLUCID_GBUFFER_UNLIT 1u  // flag: the emitted radiance is all there is

// Pass group of whoever reads a G-buffer; storage images start at PELLUCID_PASS_IMAGE_0.
#define PELLUCID_GBUFFER_0 12
#define PELLUCID_GBUFFER_1 13
#define PELLUCID_GBUFFER_2 14
#define PELLUCID_GBUFFER_3 15
#define PELLUCID_GBUFFER_EMISSIVE 16
#define PELLUCID_GBUFFER_DEPTH 17

PELLUCID_GPU_BEGIN
/// One pixel of the compact layout as a compute pass writes it to a buffer (tests, measurement).
struct GBufferTexel {
    uint normal;
    uint material;
    float depth;
    uint base;  // rgba8_srgb as stored: red in the low byte
};
PELLUCID_GPU_SIZE(GBufferTexel, 16)
PELLUCID_GPU_END
#endif
