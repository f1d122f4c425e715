// SPDX-License-Identifier: MIT
// Octahedral unit vectors in 2 × snorm16 (Meyer et al. 2010; "precise" rounding after Cigolle et al. 2014: of the four
// neighbouring codes the one nearest to the vector).  Integers are written, so no driver's snorm rounding matters.
#ifndef PELLUCID_OCTAHEDRAL_GLSL
#define PELLUCID_OCTAHEDRAL_GLSL
#include "common/exact.glsl"

vec3 octahedral_decode_codes(vec2 codes) {
    precise vec2 e = codes * (1.0 / 32767.0);
    precise float z = 1.0 - abs(e.x);
    z = z - abs(e.y);
    vec2 folded = vec2(e.x >= 0.0 ? 1.0 : -1.0, e.y >= 0.0 ? 1.0 : -1.0);
    precise vec2 flipped = (1.0 - abs(e.yx)) * folded;
    return vec3(z < 0.0 ? flipped : e, z);
}

// Codes → unit vector.
vec3 octahedral_decode(uint code) {
    int x = int(code << 16u) >> 16;
    int y = int(code) >> 16;
    vec3 v = octahedral_decode_codes(vec2(float(x), float(y)));
    precise float s = inversesqrt(dot3_always(v, v));
    precise vec3 n = v * s;
    return n;
}

// Unit vector → codes.  Largest angular error 0.0025 degrees; axes are exact.
uint octahedral_encode(vec3 n) {
    precise float l1 = abs(n.x) + abs(n.y);
    l1 = l1 + abs(n.z);
    precise float s = 1.0 / l1;
    precise vec2 p = n.xy * s;
    vec2 folded = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    precise vec2 flipped = (1.0 - abs(p.yx)) * folded;
    p = n.z < 0.0 ? flipped : p;
    precise vec2 scaled = p * 32767.0;
    vec2 low = clamp(floor(scaled), -32767.0, 32767.0);
    vec2 best = low;
    float closest = 8.0;
    for (int i = 0; i < 4; ++i) {
        vec2 codes = min(low + vec2(float(i & 1), float(i >> 1)), 32767.0);
        vec3 v = octahedral_decode_codes(codes);
        // Squared distance: a dot product near 1 has no digits left to tell the four apart.
        precise vec3 off = v * inversesqrt(dot3_always(v, v)) - n;
        precise float c = dot3_always(off, off);
        if (c < closest) {
            closest = c;
            best = codes;
        }
    }
    return (uint(int(best.x)) & 0xFFFFu) | (uint(int(best.y)) << 16u);
}
#endif
