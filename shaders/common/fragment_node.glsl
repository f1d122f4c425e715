// SPDX-License-Identifier: MIT
// A fragment as the lists hold it.  Its key, depth bits and draw order, comes first; then either what it looks like
// (16 bytes: premultiplied colour as 3 × binary16, alpha in 19 bits) or the surface that is still to be lit (32 bytes:
// octahedral normal, roughness16|metallic8|occlusion8; base colour as 3 × unorm16, alpha in 19 bits, emitted radiance as
// 3 × binary16, instance16).  k/255 is exact in unorm16 and in alpha, and so are 0 and 1.  The low three bits of alpha lie
// in the signs of three halves, which are never negative: thousands of thin layers multiply its error.
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
uint unorm16(float v) {
    precise float scaled = v * 65535.0;
    return uint(scaled + 0.5);
}
float from_unorm16(uint bits) {
    precise float v = float(bits) * (1.0 / 65535.0);
    return v;
}
const uvec2 HALF_SIGNS = uvec2(0x80008000u, 0x8000u);
uint alpha19(float v) {
    precise float scaled = v * (255.0 * 2056.0);
    return uint(scaled + 0.5);
}
uvec2 alpha_in_signs(uint alpha) { return uvec2((alpha & 1u) << 15u | (alpha & 2u) << 30u, (alpha & 4u) << 13u); }
float from_alpha19(uint high16, uvec2 signs) {
    uint low = (signs.x >> 15u & 1u) | (signs.x >> 30u & 2u) | (signs.y >> 13u & 4u);
    precise float v = float(high16 << 3u | low) * (1.0 / (255.0 * 2056.0));
    return v;
}
// Three halves, and 16 bits that are the caller's.
uvec2 pack_halves(vec3 rounded, uint alpha, uint high16) {
    uvec2 halves = uvec2(packHalf2x16(rounded.rg), packHalf2x16(vec2(rounded.b, 0.0)));
    return (halves & ~HALF_SIGNS) | alpha_in_signs(alpha) | uvec2(0u, high16 << 16u);
}
vec3 unpack_halves(uvec2 bits) {
    uvec2 halves = bits & ~HALF_SIGNS;
    return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
}

// `order`: grows with the draw order.  0 < order < 2^31.
uvec4 pack_color_node(float depth, uint order, vec4 premultiplied) {
    uint alpha = alpha19(premultiplied.a);
    return uvec4(floatBitsToUint(depth), order, pack_halves(round_to_half(premultiplied.rgb), alpha, alpha >> 3u));
}
vec4 unpack_color_node(uvec2 color) { return vec4(unpack_halves(color), from_alpha19(color.y >> 16u, color)); }
#endif
