// SPDX-License-Identifier: MIT
// A fragment as the lists hold it.  Its key, depth bits and draw order, comes first; then either what it looks like
// (16 bytes: premultiplied colour as 3 × binary16, alpha as unorm16) or the surface that is still to be lit (32 bytes:
// octahedral normal, roughness16|metallic8|occlusion8; base colour and alpha as 4 × unorm16, emitted radiance as
// 3 × binary16, instance16).  k/255 is exact in unorm16, and so are 0 and 1.
#ifndef PELLUCID_FRAGMENT_NODE_GLSL
#define PELLUCID_FRAGMENT_NODE_GLSL
#include "pellucid/gpu/fragment_lists.h"

ivec2 node_texel(uint place) {
    return ivec2(place & ((1u << PELLUCID_LISTS_WIDTH_BITS) - 1u), place >> PELLUCID_LISTS_WIDTH_BITS);
}

// Rounds to what binary16 holds, to nearest: drivers' own conversions differ.  Precondition: 0 <= c <= 65504.
vec3 round_to_half(vec3 c) {
    uvec3 bits = floatBitsToUint(c);
    bits += 0xFFFu + ((bits >> 13u) & 1u);
    return min(uintBitsToFloat(bits & 0xFFFFE000u), vec3(65504.0));
}
uint half_bits(float rounded) { return packHalf2x16(vec2(rounded, 0.0)) & 0xFFFFu; }
uint unorm16(float v) {
    precise float scaled = v * 65535.0;
    return uint(scaled + 0.5);
}
float from_unorm16(uint bits) {
    precise float v = float(bits) * (1.0 / 65535.0);
    return v;
}

// `order`: grows with the draw order.  0 < order < 2^31.
uvec4 pack_color_node(float depth, uint order, vec4 premultiplied) {
    vec3 c = round_to_half(premultiplied.rgb);
    return uvec4(floatBitsToUint(depth), order, packHalf2x16(c.rg),
                 half_bits(c.b) | unorm16(premultiplied.a) << 16u);
}
vec4 unpack_color_node(uvec2 color) {
    return vec4(unpackHalf2x16(color.x), unpackHalf2x16(color.y).x, from_unorm16(color.y >> 16u));
}
#endif
