// SPDX-License-Identifier: MIT
// Groups of PELLUCID_LAYERS_GROUP neighbouring pixels, as passes that count and store fragments see them.
#ifndef PELLUCID_LAYER_GROUPS_GLSL
#define PELLUCID_LAYER_GROUPS_GLSL
#include "common/prelude.glsl"
#include "pellucid/gpu/layer_count.h"

PASS_IMAGE(PELLUCID_LAYERS_COUNTS, r32f) readonly image2D counts;

// What the group in column `at.x` of row `at.y` adds up to.
LayerStrip sum_group(uvec2 at) {
    LayerStrip sum = LayerStrip(0u, 0u, 0u, 0u);
    for (uint i = 0u; i < PELLUCID_LAYERS_GROUP; ++i) {
        // Beyond the picture an image reads as 0.
        uint n = uint(imageLoad(counts, ivec2(at.x * PELLUCID_LAYERS_GROUP + i, at.y)).r);
        sum.fragments += n;
        sum.deepest = max(sum.deepest, n);
        sum.covered += min(n, 1u);
    }
    sum.slots = sum.deepest * PELLUCID_LAYERS_GROUP;
    return sum;
}
#endif
