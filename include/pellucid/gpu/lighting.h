// SPDX-License-Identifier: MIT
// The lighting pass binds a G-buffer (gpu/gbuffer.h) and, in its compute variant, the target as a storage image.
#ifndef PELLUCID_GPU_LIGHTING_H
#define PELLUCID_GPU_LIGHTING_H
#include "pellucid/gpu/gbuffer.h"
#define PELLUCID_LIGHTING_OUTPUT 0     // storage image, rgba16f: linear radiance
#define PELLUCID_LIGHTING_TILE_SIZE 8  // workgroup edge [pixel]
#endif
