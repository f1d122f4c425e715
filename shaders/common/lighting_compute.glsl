// SPDX-License-Identifier: MIT
#include "common/shade_pixel.glsl"
#include "pellucid/gpu/lighting.h"
layout(local_size_x = PELLUCID_LIGHTING_TILE_SIZE, local_size_y = PELLUCID_LIGHTING_TILE_SIZE) in;
PASS_IMAGE(PELLUCID_LIGHTING_OUTPUT, rgba16f) writeonly image2D hdr;
#if defined(LIGHTING_LAYERS)
PASS_IMAGE(PELLUCID_INTERLEAVED_OUTPUT, rgba16f) writeonly image2D layer_light;
#endif

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(hdr)))) return;
    imageStore(hdr, at, shade_pixel(at));
#if defined(LIGHTING_LAYERS)
    imageStore(layer_light, at, shade_layer(at));
#endif
}
