// SPDX-License-Identifier: MIT
// Packing of the compact G-buffer (gpu/gbuffer.h).
#ifndef PELLUCID_GBUFFER_GLSL
#define PELLUCID_GBUFFER_GLSL
#include "common/octahedral.glsl"
#include "common/surface.glsl"
#include "pellucid/gpu/gbuffer.h"

uint pack_material(float roughness, float metallic, uint flags) {
    precise float r = roughness * 65535.0;
    precise float m = metallic * 255.0;
    return uint(r + 0.5) | uint(m + 0.5) << 16u | flags << 24u;
}
float material_roughness(uint m) {
    precise float r = float(m & 0xFFFFu) * (1.0 / 65535.0);
    return r;
}
float material_metallic(uint m) {
    precise float r = float((m >> 16u) & 0xFFu) * (1.0 / 255.0);
    return r;
}
uint material_flags(uint m) { return m >> 24u; }

// Rotations between view space and world space (the classic layout stores world positions).
vec3 world_from_view(vec3 v) {
    precise vec3 w = frame.world_x.xyz * v.x;
    w = w + frame.world_y.xyz * v.y;
    w = w + frame.world_z.xyz * v.z;
    return w;
}
vec3 view_from_world(vec3 w) {
    return vec3(dot3_always(frame.world_x.xyz, w), dot3_always(frame.world_y.xyz, w), dot3_always(frame.world_z.xyz, w));
}

uint surface_flags(Surface s) { return s.unlit ? PELLUCID_GBUFFER_UNLIT : 0u; }
#endif
