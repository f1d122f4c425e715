// SPDX-License-Identifier: MIT
#include "common/shade_pixel.glsl"
layout(location = 0) out vec4 out_hdr;
#if defined(LIGHTING_LAYERS)
layout(location = 1) out vec4 out_layer_light;
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    out_hdr = shade_pixel(at, fetch_gbuffer(at));
#if defined(LIGHTING_LAYERS)
    out_layer_light = shade_layer(at);
#endif
}
