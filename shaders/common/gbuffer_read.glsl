// SPDX-License-Identifier: MIT
// One pixel of the G-buffer, whichever layout it has.  GBUFFER_CLASSIC is set by the entry file.
#include "common/gbuffer.glsl"

#if defined(GBUFFER_CLASSIC)
PASS_TEXTURE(PELLUCID_GBUFFER_0) sampler2D gbuffer_position;
PASS_TEXTURE(PELLUCID_GBUFFER_1) sampler2D gbuffer_normal;
PASS_TEXTURE(PELLUCID_GBUFFER_2) sampler2D gbuffer_base;
PASS_TEXTURE(PELLUCID_GBUFFER_3) sampler2D gbuffer_material;
#else
PASS_TEXTURE(PELLUCID_GBUFFER_0) usampler2D gbuffer_normal;
PASS_TEXTURE(PELLUCID_GBUFFER_1) sampler2D gbuffer_base;
PASS_TEXTURE(PELLUCID_GBUFFER_2) usampler2D gbuffer_material;
#endif
PASS_TEXTURE(PELLUCID_GBUFFER_EMISSIVE) sampler2D gbuffer_emissive;
PASS_TEXTURE(PELLUCID_GBUFFER_DEPTH) sampler2D gbuffer_depth;

struct Pixel {
    Surface surface;
    vec3 position;  // view space
    vec3 plane;     // unit normal of the surface itself, whatever its shading normal is; only where there are shadows
    bool covered;
};

// The neighbour in a direction, or against it, whose depth is closer to the pixel's: it is of the same surface more
// likely.  z: its depth; 0 where both are outside or show nothing.
vec3 beside(ivec2 at, ivec2 step, float depth) {
    ivec2 a = at + step, b = at - step, size = ivec2(frame.pixel.zw);
    float da = a.x < size.x && a.y < size.y ? texelFetch(gbuffer_depth, a, 0).r : 0.0;
    float db = b.x >= 0 && b.y >= 0 ? texelFetch(gbuffer_depth, b, 0).r : 0.0;
    bool first = da != 0.0 && (db == 0.0 || abs(da - depth) <= abs(db - depth));
    return first ? vec3(vec2(a) + 0.5, da) : vec3(vec2(b) + 0.5, db);
}

// The normal of the plane through a pixel and its neighbours, towards the eye; the stored one where there are none, or
// where they say so little that it is more than 60° off.
vec3 plane_normal(ivec2 at, float depth, vec3 stored) {
    vec3 h = beside(at, ivec2(1, 0), depth), v = beside(at, ivec2(0, 1), depth);
    if (h.z == 0.0 || v.z == 0.0) return stored;
    vec3 p = view_from_depth(vec2(at) + 0.5, depth);
    EXACT vec3 dx = view_from_depth(h.xy, h.z) - p;
    EXACT vec3 dy = view_from_depth(v.xy, v.z) - p;
    vec3 n = cross3(dx, dy);
    float l = dot3(n, n);
    if (!(l > 1e-36)) return stored;
    n = unit(n);
    float same = dot3(n, stored);
    return abs(same) < 0.5 ? stored : same < 0.0 ? -n : n;
}

// What is stored of a pixel.  Read as a whole, before anything depends on it: then all of it is under way at once.
struct Stored {
    float depth;
    vec4 base;
#if defined(GBUFFER_CLASSIC)
    vec3 position;
    vec3 normal;
    vec4 material;
#else
    uint normal;
    uint material;
#endif
    vec3 emissive;
};

Stored fetch_gbuffer(ivec2 at) {
    Stored s;
    s.depth = texelFetch(gbuffer_depth, at, 0).r;
    s.base = texelFetch(gbuffer_base, at, 0);
#if defined(GBUFFER_CLASSIC)
    s.position = texelFetch(gbuffer_position, at, 0).xyz;
    s.normal = texelFetch(gbuffer_normal, at, 0).xyz;
    s.material = texelFetch(gbuffer_material, at, 0);
#else
    s.normal = texelFetch(gbuffer_normal, at, 0).r;
    s.material = texelFetch(gbuffer_material, at, 0).r;
#endif
    s.emissive = needs(PELLUCID_NEED_EMISSIVE) ? texelFetch(gbuffer_emissive, at, 0).rgb : vec3(0.0);
    return s;
}

Pixel decode_gbuffer(ivec2 at, Stored s) {
    Pixel p;
    p.covered = s.depth != 0.0;
    if (!p.covered) return p;
    p.surface.base = s.base.rgb;
#if defined(GBUFFER_CLASSIC)
    p.surface.metallic = s.material.r;
    p.surface.roughness = s.material.g;
    p.surface.occlusion = s.material.b;
    p.surface.unlit = s.material.a > 0.0;
    p.surface.normal = unit(s.normal);
    EXACT vec3 relative = s.position - frame.camera_position;
    p.position = view_from_world(relative);
#else
    p.surface.metallic = material_metallic(s.material);
    p.surface.roughness = material_roughness(s.material);
    p.surface.occlusion = s.base.a;
    p.surface.unlit = (material_flags(s.material) & PELLUCID_GBUFFER_UNLIT) != 0u;
    p.surface.normal = octahedral_decode(s.normal);
    p.position = view_from_depth(vec2(at) + 0.5, s.depth);
#endif
    p.plane = needs(PELLUCID_NEED_SHADOWS) ? plane_normal(at, s.depth, p.surface.normal) : p.surface.normal;
    p.surface.emissive = s.emissive;
    return p;
}
