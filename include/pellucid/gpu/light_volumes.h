// SPDX-License-Identifier: MIT
// Lights as volumes: spheres and cones around what a light with a range reaches.
#ifndef PELLUCID_GPU_LIGHT_VOLUMES_H
#define PELLUCID_GPU_LIGHT_VOLUMES_H
#include "pellucid/gpu/gbuffer.h"

#define PELLUCID_VOLUMES_TARGET 0  // storage image, rgba16f: the picture so far
#define PELLUCID_VOLUMES_SUM 12    // sampled, rgba32f: what the volumes added
#define PELLUCID_VOLUMES_MESH 18   // storage block: vec4 a corner: triangles of a unit sphere, then of a unit cone

PELLUCID_GPU_BEGIN
/// Push data of one light's volume.
struct LightVolumePush {
    uint light;         // index of the light
    uint first_corner;  // of its mesh
    float reach;        // [m] of a sphere: its radius; of a cone: along its axis
    float width;        // [m] of a cone: radius at its end
};
PELLUCID_GPU_SIZE(LightVolumePush, 16)
PELLUCID_GPU_END
#endif
