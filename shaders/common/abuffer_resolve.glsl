// SPDX-License-Identifier: MIT
// Composites all fragments of a pixel.  The entry file defines the window; with ABUFFER_LIT the fragments are surfaces, lit
// here, where what is hidden costs nothing.
#if defined(ABUFFER_LIT)
#define VISIT_IN_LOOP
#include "common/surface_node.glsl"
#endif
#include "common/list_compositor.glsl"

#if defined(ABUFFER_LIT)
PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) readonly uimage2D looks;

vec4 stored_color(uint place) {
    uvec4 node = imageLoad(nodes, node_texel(place));
    Surface s = unpack_surface(node, imageLoad(looks, node_texel(place)));
    EXACT vec3 radiance = s.emissive + light_surface(s, pixel, node_depth(node));
    return premultiply(s, radiance);
}
#else
vec4 stored_color(uint place) { return unpack_color_node(imageLoad(nodes, node_texel(place)).zw); }
#endif

// The audit: fragments composited.
vec4 fragment_color(uint rank, uint place) {
    ++tally;
    return stored_color(place);
}
