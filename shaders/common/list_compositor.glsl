// SPDX-License-Identifier: MIT
// Composites a pixel's fragments front to back over what is opaque (Porter and Duff 1984), in single precision.  The file
// that includes it defines `fragment_color`; the window of the walk as in common/fragment_lists.glsl.
#ifndef PELLUCID_LIST_COMPOSITOR_GLSL
#define PELLUCID_LIST_COMPOSITOR_GLSL
#include "common/fragment_lists.glsl"
#include "pellucid/gpu/list_compositor.h"

SPEC_CONSTANT(2, AUDIT, 0u);
PASS_IMAGE(PELLUCID_COMPOSITOR_TARGET, rgba16f) image2D hdr;
PASS_IMAGE(PELLUCID_COMPOSITOR_AUDIT, r32ui) writeonly uimage2D audited;

// Not declared precise: glslang 12 would make such globals local to the first function that names them.
ivec2 pixel;
vec3 composite;
float through;
uint tally;  // what `fragment_color` counts, for an audit

// Premultiplied radiance and alpha of a stored fragment, 0 the nearest.
vec4 fragment_color(uint rank, uint place);

bool visit(uint rank, uint place) {
    vec4 c = fragment_color(rank, place);
    precise vec3 sum = composite + c.rgb * through;
    precise float left = through * (1.0 - c.a);
    composite = sum;
    through = left;
    return through > band.min_transmittance;
}

void main() {
    if (!find_pixel(pixel)) return;
    uint count = fragment_count(pixel);
    composite = vec3(0.0);
    through = 1.0;
    tally = 0u;
    walk(pixel, count);
    if (count == 0u) return;
    if (AUDIT != 0u) imageStore(audited, pixel, uvec4(tally));
    vec4 behind = imageLoad(hdr, pixel);
    precise vec3 sum = composite + behind.rgb * through;
    imageStore(hdr, pixel, vec4(min(sum, vec3(65504.0)), behind.a));
}
#endif
