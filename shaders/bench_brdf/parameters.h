// SPDX-License-Identifier: MIT
// What the loop over terms of reflection models is told, and the terms that it can evaluate.
#ifndef PELLUCID_BENCH_BRDF_PARAMETERS_H
#define PELLUCID_BENCH_BRDF_PARAMETERS_H
#include "pellucid/gpu/types.h"

#define BENCH_BRDF_OUTPUT 0       // storage image, r32f: the sum of an invocation
#define BENCH_BRDF_PARAMETERS 12  // uniform block
#define BENCH_BRDF_TABLE 13       // sampled: loss, shift, average loss, average bias

// Groups have the same inputs; the first of a group only adds the inputs up.
#define BENCH_BRDF_D_INPUTS 0u
#define BENCH_BRDF_D_SEED 1u        // NoH² (a² - 1) + 1
#define BENCH_BRDF_D_COMPLEMENT 2u  // 1 - NoH²
#define BENCH_BRDF_D_LAGRANGE 3u    // |N×H|²

#define BENCH_BRDF_V_INPUTS 10u
#define BENCH_BRDF_V_EXACT 11u
#define BENCH_BRDF_V_HAMMON 12u
#define BENCH_BRDF_V_UNCORRELATED 13u
#define BENCH_BRDF_V_SCHLICK 14u
#define BENCH_BRDF_V_SEED 15u

#define BENCH_BRDF_E_INPUTS 20u
#define BENCH_BRDF_E_QUADRATURE 21u
#define BENCH_BRDF_E_TABLE 22u
#define BENCH_BRDF_E_KARIS 23u
#define BENCH_BRDF_E_LAZAROV 24u
#define BENCH_BRDF_E_POLYNOMIAL 25u
#define BENCH_BRDF_E_CUBE 26u

#define BENCH_BRDF_MODEL_INPUTS 30u
#define BENCH_BRDF_MODEL_GLTF 31u
#define BENCH_BRDF_MODEL_SEED 32u
#define BENCH_BRDF_MODEL_BLINN_PHONG 33u
#define BENCH_BRDF_MODEL_CONSERVING 34u

// The models' surface, in all channels.
#define BENCH_BRDF_BASE 0.8
#define BENCH_BRDF_METALLIC 0.5

PELLUCID_GPU_BEGIN
struct BrdfParameters {
    vec3 normal;  // unit
    uint count;   // evaluations of an invocation
    float scale;  // of the table's coordinates in [0,1]: (size - 1)/size
    float offset; // 1/2 / size
    uint reserved0;
    uint reserved1;
};
PELLUCID_GPU_SIZE(BrdfParameters, 32)
PELLUCID_GPU_END
#endif
