// SPDX-License-Identifier: MIT
// Step 1 of 4: what the C++ side and the shader share.  Valid C++20 and valid GLSL, with one layout in both: see
// pellucid/gpu/types.h for the rules, which the two macros at the end check in C++.
#ifndef PELLUCID_SAMPLES_EDGES_H
#define PELLUCID_SAMPLES_EDGES_H
#include "pellucid/gpu/bindings.h"
#include "pellucid/gpu/types.h"

// Numbers of the pass group: storage images from PELLUCID_PASS_IMAGE_0 on, all else from PELLUCID_PASS_0 on.
#define EDGES_OUTPUT 0    // storage image, rgba8
#define EDGES_PICTURE 12  // sampled: display codes
#define EDGES_DEPTH 13    // sampled, d32_float
#define EDGES_GROUP_SIZE 16

PELLUCID_GPU_BEGIN
struct Edges {
    vec4 line;                                     // colour, in display codes / 255, and opacity
    float threshold PELLUCID_GPU_DEFAULT(0.002f);  // bends up to here are no edge
    float softness PELLUCID_GPU_DEFAULT(0.004f);   // from there to a full line, > 0
    float reserved0;
    float reserved1;
};
PELLUCID_GPU_SIZE(Edges, 32)
PELLUCID_GPU_OFFSET(Edges, threshold, 16)
PELLUCID_GPU_END
#endif
