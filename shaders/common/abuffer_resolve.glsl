// SPDX-License-Identifier: MIT
// Composites a pixel's fragments front to back over what is opaque.  The entry file defines the window; with ABUFFER_LIT the
// fragments are surfaces, lit here, where what is hidden costs nothing.
#if defined(ABUFFER_LIT)
#define VISIT_IN_LOOP
#include "common/surface_node.glsl"
#endif
#include "common/fragment_lists.glsl"
#include "pellucid/gpu/abuffer.h"

SPEC_CONSTANT(2, AUDIT, 0u);
PASS_IMAGE(PELLUCID_ABUFFER_AUDIT, r32ui) writeonly uimage2D composited;
PASS_IMAGE(PELLUCID_ABUFFER_TARGET, rgba16f) image2D hdr;

// Not declared precise: glslang 12 would make such globals local to the first function that names them.
ivec2 pixel;
vec3 composite;
float through;
uint done;

#if defined(ABUFFER_LIT)
PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) readonly uimage2D looks;

vec4 fragment_color(uint place) {
    uvec4 node = imageLoad(nodes, node_texel(place));
    Surface s = unpack_surface(node, imageLoad(looks, node_texel(place)));
    EXACT vec3 radiance = s.emissive + light_surface(s, pixel, node_depth(node));
    return premultiply(s, radiance);
}
#else
vec4 fragment_color(uint place) { return unpack_color_node(imageLoad(nodes, node_texel(place)).zw); }
#endif

bool visit(uint rank, uint place) {
    vec4 c = fragment_color(place);
    precise vec3 sum = composite + c.rgb * through;
    precise float left = through * (1.0 - c.a);
    composite = sum;
    through = left;
    ++done;
    return through > band.min_transmittance;
}

void main() {
    if (!find_pixel(pixel)) return;
    uint count = fragment_count(pixel);
    composite = vec3(0.0);
    through = 1.0;
    done = 0u;
    walk(pixel, count);
    if (count == 0u) return;
    if (AUDIT != 0u) imageStore(composited, pixel, uvec4(done));
    vec4 behind = imageLoad(hdr, pixel);
    precise vec3 sum = composite + behind.rgb * through;
    imageStore(hdr, pixel, vec4(min(sum, vec3(65504.0)), behind.a));
}
