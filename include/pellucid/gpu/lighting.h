// SPDX-License-Identifier: MIT
// The lighting pass binds a G-buffer (gpu/gbuffer.h) and, in its compute variant, the target as a storage image.
#ifndef PELLUCID_GPU_LIGHTING_H
#define PELLUCID_GPU_LIGHTING_H
#include "pellucid/gpu/gbuffer.h"
#define PELLUCID_LIGHTING_OUTPUT 0      // storage image, rgba16f: linear radiance
#define PELLUCID_LIGHTING_GROUP_SIZE 8  // workgroup edge [thread]
#define PELLUCID_LIGHTING_PIXELS 4      // that a thread lights, one below the other
#endif
