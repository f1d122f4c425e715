// SPDX-License-Identifier: MIT
// What scene_vertex.glsl hands to a fragment shader, as load_surface wants it.
#ifndef PELLUCID_GEOMETRY_IN_GLSL
#define PELLUCID_GEOMETRY_IN_GLSL
#include "common/surface.glsl"

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;
// Material, PELLUCID_DRAW_* with PELLUCID_MATERIAL_* in the upper half, id of the draw's triangle 0, instance.
layout(location = 4) flat in uvec4 in_draw;
layout(location = 5) flat in vec4 in_base_color;
layout(location = 6) flat in vec4 in_factors;   // metallic, roughness, alpha cutoff, occlusion strength
layout(location = 7) flat in vec4 in_emissive;  // and the normal map's scale

Attributes fragment_attributes() {
    Attributes a;
    a.normal = in_normal;
    a.tangent = in_tangent;
    a.uv = in_uv;
    a.uv_dx = dFdxFine(in_uv);
    a.uv_dy = dFdyFine(in_uv);
    a.color = (in_draw.y & PELLUCID_DRAW_COLORS) != 0u ? in_color : vec4(1.0);
    a.front = gl_FrontFacing != ((in_draw.y & PELLUCID_DRAW_MIRRORED) != 0u);
    return a;
}

// The draw's material; only its textures are looked up in the table.
MaterialRecord fragment_material() {
    MaterialRecord m;
    if (needs(PELLUCID_NEED_TEXTURES)) m = materials[in_draw.x];
    m.base_color = in_base_color;
    m.metallic = in_factors.x;
    m.roughness = in_factors.y;
    m.alpha_cutoff = in_factors.z;
    m.occlusion_strength = in_factors.w;
    m.emissive = in_emissive.xyz;
    m.normal_scale = in_emissive.w;
    m.flags = in_draw.y >> 16u;
    return m;
}

// Grows with the draw order over the whole frame; 0 < order.
uint fragment_order() { return in_draw.z + uint(gl_PrimitiveID) + 1u; }

Surface fragment_surface() { return load_surface(fragment_material(), fragment_attributes()); }
#endif
