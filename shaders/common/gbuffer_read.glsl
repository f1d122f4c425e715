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
    bool covered;
};

Pixel read_gbuffer(ivec2 at) {
    Pixel p;
    // Everything is fetched at once, covered or not: a fetch behind a branch waits for the depth first.
    float depth = texelFetch(gbuffer_depth, at, 0).r;
    vec4 base = texelFetch(gbuffer_base, at, 0);
#if defined(GBUFFER_CLASSIC)
    vec4 m = texelFetch(gbuffer_material, at, 0);
    vec3 n = texelFetch(gbuffer_normal, at, 0).xyz, position = texelFetch(gbuffer_position, at, 0).xyz;
#else
    uint m = texelFetch(gbuffer_material, at, 0).r;
    uint n = texelFetch(gbuffer_normal, at, 0).r;
#endif
    p.covered = depth != 0.0;
    if (!p.covered) return p;
    p.surface.base = base.rgb;
#if defined(GBUFFER_CLASSIC)
    p.surface.metallic = m.r;
    p.surface.roughness = m.g;
    p.surface.occlusion = m.b;
    p.surface.unlit = m.a > 0.0;
    p.surface.normal = unit(n);
    EXACT vec3 relative = position - frame.camera_position;
    p.position = view_from_world(relative);
#else
    p.surface.metallic = material_metallic(m);
    p.surface.roughness = material_roughness(m);
    p.surface.occlusion = base.a;
    p.surface.unlit = (material_flags(m) & PELLUCID_GBUFFER_UNLIT) != 0u;
    p.surface.normal = octahedral_decode(n);
    p.position = view_from_depth(vec2(at) + 0.5, depth);
#endif
    p.surface.emissive = needs(PELLUCID_NEED_EMISSIVE) ? texelFetch(gbuffer_emissive, at, 0).rgb : vec3(0.0);
    return p;
}
