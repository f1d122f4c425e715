// SPDX-License-Identifier: MIT
// Several pixels a thread, one below the other, of which the next is fetched while one is lit: GPUs start about one group
// a clock, and what a pixel waits for takes as long as lighting it (benchmarks/lighting).
#include "common/shade_pixel.glsl"
#include "pellucid/gpu/lighting.h"
layout(local_size_x = PELLUCID_LIGHTING_GROUP_SIZE, local_size_y = PELLUCID_LIGHTING_GROUP_SIZE) in;
PASS_IMAGE(PELLUCID_LIGHTING_OUTPUT, rgba16f) writeonly image2D hdr;
#if defined(LIGHTING_LAYERS)
PASS_IMAGE(PELLUCID_INTERLEAVED_OUTPUT, rgba16f) writeonly image2D layer_light;
#endif

void main() {
    const ivec2 tile = ivec2(PELLUCID_LIGHTING_GROUP_SIZE, PELLUCID_LIGHTING_GROUP_SIZE * PELLUCID_LIGHTING_PIXELS);
    ivec2 size = imageSize(hdr), at = ivec2(gl_WorkGroupID.xy) * tile + ivec2(gl_LocalInvocationID.xy);
    Stored stored = fetch_gbuffer(min(at, size - 1));
    for (int i = 0; i < PELLUCID_LIGHTING_PIXELS; ++i) {
        ivec2 below = at + ivec2(0, PELLUCID_LIGHTING_GROUP_SIZE);
        Stored next = fetch_gbuffer(min(below, size - 1));
        if (any(greaterThanEqual(at, size))) return;
        imageStore(hdr, at, shade_pixel(at, stored));
#if defined(LIGHTING_LAYERS)
        imageStore(layer_light, at, shade_layer(at));
#endif
        at = below;
        stored = next;
    }
}
