// SPDX-License-Identifier: MIT
// Surfaces in the lists of fragments (fragment_node.glsl), and what light makes of them.
#ifndef PELLUCID_SURFACE_NODE_GLSL
#define PELLUCID_SURFACE_NODE_GLSL
#include "common/fragment_node.glsl"
#include "common/octahedral.glsl"
#include "common/surface.glsl"
#include "common/lighting.glsl"

#define PELLUCID_NODE_UNLIT 1u
#define PELLUCID_NODE_PREMULTIPLIED 2u

// `order`: grows with the draw order.  0 < order < 2^29.
uvec4 pack_surface_node(Surface s, float depth, uint order) {
    uint flags = (s.unlit ? PELLUCID_NODE_UNLIT : 0u) | (s.premultiplied ? PELLUCID_NODE_PREMULTIPLIED : 0u);
    precise float metallic = s.metallic * 255.0;
    precise float occlusion = s.occlusion * 255.0;
    return uvec4(floatBitsToUint(depth), order << 2u | flags, octahedral_encode(s.normal),
                 unorm16(s.roughness) | uint(metallic + 0.5) << 16u | uint(occlusion + 0.5) << 24u);
}
uvec4 pack_surface_look(Surface s, uint instance) {
    vec3 base = clamp(s.base, 0.0, 1.0);
    vec3 emissive = round_to_half(min(s.emissive, vec3(65504.0)));
    uint alpha = alpha19(s.alpha);
    return uvec4(unorm16(base.r) | unorm16(base.g) << 16u, unorm16(base.b) | (alpha >> 3u) << 16u,
                 pack_halves(emissive, alpha, instance));
}
float node_depth(uvec4 node) { return uintBitsToFloat(node.x); }
uint look_instance(uvec4 look) { return look.w >> 16u; }

Surface unpack_surface(uvec4 node, uvec4 look) {
    Surface s;
    s.base = vec3(from_unorm16(look.x & 0xFFFFu), from_unorm16(look.x >> 16u), from_unorm16(look.y & 0xFFFFu));
    s.alpha = from_alpha19(look.y >> 16u, look.zw);
    s.normal = octahedral_decode(node.z);
    s.roughness = from_unorm16(node.w & 0xFFFFu);
    precise float metallic = float(node.w >> 16u & 0xFFu) * (1.0 / 255.0);
    precise float occlusion = float(node.w >> 24u) * (1.0 / 255.0);
    s.metallic = metallic;
    s.occlusion = occlusion;
    s.emissive = unpack_halves(look.zw);
    s.unlit = (node.y & PELLUCID_NODE_UNLIT) != 0u;
    s.premultiplied = (node.y & PELLUCID_NODE_PREMULTIPLIED) != 0u;
    s.discarded = false;
    return s;
}

// What light adds to the surface at a pixel.
vec3 light_surface(Surface s, ivec2 at, float depth) {
    if (s.unlit) return vec3(0.0);
    vec3 p = view_from_depth(vec2(at) + 0.5, depth);
    return evaluate_lighting(s.base, s.metallic, s.roughness, s.occlusion, s.normal, lit_point(at, p, s.normal, true));
}
#endif
