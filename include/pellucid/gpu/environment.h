// SPDX-License-Identifier: MIT
// An environment as a prefiltered cube map.  Level l of 0 … last is prefiltered by the GGX lobe of roughness (l/last)²;
// level 0 is the environment itself, the last one is also what a white perfect diffuser returns.
#ifndef PELLUCID_GPU_ENVIRONMENT_H
#define PELLUCID_GPU_ENVIRONMENT_H
#include "pellucid/gpu/types.h"

#define PELLUCID_ENVIRONMENT_TARGET 0    // storage image: a level of a cube
#define PELLUCID_ENVIRONMENT_ABOVE 1     // storage image: the level of the source that is halved
#define PELLUCID_ENVIRONMENT_PICTURE 12  // sampled: equirectangular, rgba32f
#define PELLUCID_ENVIRONMENT_SOURCE 13   // sampled cube: rgba32f with levels

#define PELLUCID_ENVIRONMENT_LEAST 8      // side of the last level [texel]
#define PELLUCID_ENVIRONMENT_SAMPLES 512  // of narrow lobes
#define PELLUCID_ENVIRONMENT_NARROW 0.1   // roughness up to which lobes are sampled; wider ones are summed
#define PELLUCID_ENVIRONMENT_THREADS 8    // workgroup edge

PELLUCID_GPU_BEGIN
/// Push data of what makes one level of a cube map.
struct EnvironmentPush {
    uint size;    // side of the level that is written [texel]
    float alpha;  // of the lobe
    float level;  // of the source that is summed over
    uint side;    // of that level [texel]
};
PELLUCID_GPU_SIZE(EnvironmentPush, 16)
PELLUCID_GPU_END
#endif
