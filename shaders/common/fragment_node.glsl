// SPDX-License-Identifier: MIT
// A shaded fragment in 16 bytes: depth, draw order, premultiplied colour as 3 × binary16, alpha as unorm16 (k/255 is
// exact, and so are 0 and 1).
#ifndef PELLUCID_FRAGMENT_NODE_GLSL
#define PELLUCID_FRAGMENT_NODE_GLSL
#include "pellucid/gpu/abuffer.h"

ivec2 node_texel(uint place) {
    return ivec2(place & ((1u << PELLUCID_ABUFFER_WIDTH_BITS) - 1u), place >> PELLUCID_ABUFFER_WIDTH_BITS);
}

// Rounds to what binary16 holds, to nearest: drivers' own conversions differ.  Precondition: 0 <= c <= 65504.
vec3 round_to_half(vec3 c) {
    uvec3 bits = floatBitsToUint(c);
    bits += 0xFFFu + ((bits >> 13u) & 1u);
    return min(uintBitsToFloat(bits & 0xFFFFE000u), vec3(65504.0));
}

// `order`: grows with the draw order.  0 < order.
uvec4 pack_node(float depth, uint order, vec4 premultiplied) {
    vec3 c = round_to_half(premultiplied.rgb);
    precise float a = premultiplied.a * 65535.0;
    return uvec4(floatBitsToUint(depth), order, packHalf2x16(c.rg),
                 (packHalf2x16(vec2(c.b, 0.0)) & 0xFFFFu) | uint(a + 0.5) << 16u);
}

vec4 unpack_node_color(uvec2 color) {
    precise float a = float(color.y >> 16u) * (1.0 / 65535.0);
    return vec4(unpackHalf2x16(color.x), unpackHalf2x16(color.y).x, a);
}
#endif
