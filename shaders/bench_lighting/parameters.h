// SPDX-License-Identifier: MIT
// Parameters of the raw GGX loop: what the lighting pass reads from a G-buffer and from storage buffers, as uniforms.
#ifndef PELLUCID_BENCH_LIGHTING_PARAMETERS_H
#define PELLUCID_BENCH_LIGHTING_PARAMETERS_H
#include "pellucid/gpu/types.h"

#define BENCH_LIGHTING_OUTPUT 0       // storage image, rgba16f
#define BENCH_LIGHTING_PARAMETERS 12  // uniform block
#define BENCH_LIGHTING_LIGHTS 13      // storage block: the same lights
#define BENCH_LIGHTING_MAX_LIGHTS 256

#define BENCH_LIGHTING_PLAIN 0u     // term by term, as the lighting pass
#define BENCH_LIGHTING_FACTORED 1u  // what does not change from light to light is taken out of the loop

PELLUCID_GPU_BEGIN
struct RawLight {
    vec3 position;  // [m] view space
    float reserved0;
    vec3 intensity;  // colour times [cd]
    float reserved1;
};
PELLUCID_GPU_SIZE(RawLight, 32)

struct RawParameters {
    vec3 base;  // linear
    float metallic;
    vec2 half_extent;  // [m] of the view at `distance`
    float distance;    // [m] of the surface, a plane across the view
    float roughness;
    float lean;  // the normal is normalize(lean · ndc, 1)
    uint count;  // lights
    vec2 pixel;  // 1 / size
    RawLight lights[BENCH_LIGHTING_MAX_LIGHTS];
};
PELLUCID_GPU_SIZE(RawParameters, 48 + 32 * BENCH_LIGHTING_MAX_LIGHTS)
PELLUCID_GPU_END
#endif
