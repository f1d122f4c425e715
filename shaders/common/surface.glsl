// SPDX-License-Identifier: MIT
// load_surface: the one function that turns interpolated attributes and a material into a surface.  The G-buffer pass,
// every transparency method and compute passes that rebuild a surface from a primitive id all call it.
#ifndef PELLUCID_SURFACE_GLSL
#define PELLUCID_SURFACE_GLSL
#include "common/scene.glsl"

SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 0) sampler2DArray textures_0;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 1) sampler2DArray textures_1;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 2) sampler2DArray textures_2;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 3) sampler2DArray textures_3;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 4) sampler2DArray textures_4;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 5) sampler2DArray textures_5;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 6) sampler2DArray textures_6;
SCENE_TEXTURE(PELLUCID_BIND_TEXTURES + 7) sampler2DArray textures_7;

// What rasterisation or a compute pass interpolates over a triangle.  Derivatives are per pixel, of (uv0, uv1).
struct Attributes {
    vec3 normal;   // view space, not unit
    vec4 tangent;  // xyz view space, not unit; w = ±1
    vec4 uv;       // uv0 in xy, uv1 in zw
    vec4 uv_dx;
    vec4 uv_dy;
    vec4 color;
    bool front;    // seen from its front side
};

struct Surface {
    vec3 base;      // linear
    float alpha;    // 1 for opaque and masked materials
    vec3 normal;    // unit, on the side that is seen
    float metallic;
    vec3 emissive;  // radiance; the whole radiance for unlit materials
    float roughness;
    float occlusion;
    bool unlit;
    bool premultiplied; // radiance is not multiplied by alpha
    bool discarded;     // alpha mask
};

// Which array is uniform within a draw but need not be within a workgroup: constant indices, explicit gradients.
vec4 sample_array(uint which, vec3 at, vec2 dx, vec2 dy) {
    switch (which) {
        case 1u: return textureGrad(textures_0, at, dx, dy);
        case 2u: return textureGrad(textures_1, at, dx, dy);
        case 3u: return textureGrad(textures_2, at, dx, dy);
        case 4u: return textureGrad(textures_3, at, dx, dy);
        case 5u: return textureGrad(textures_4, at, dx, dy);
        case 6u: return textureGrad(textures_5, at, dx, dy);
        case 7u: return textureGrad(textures_6, at, dx, dy);
        default: return textureGrad(textures_7, at, dx, dy);
    }
}

vec2 transform_uv(vec4 matrix, vec2 uv) {
    precise vec2 a = matrix.xz * uv.x;
    precise vec2 b = matrix.yw * uv.y;
    precise vec2 r = a + b;
    return r;
}

// The texture's value, or `otherwise` where the material has none.
vec4 sample_use(TextureUse use, Attributes a, vec4 otherwise) {
    if (!needs(PELLUCID_NEED_TEXTURES) || use.place == 0u) return otherwise;
    bool second = needs(PELLUCID_NEED_SECOND_UV) && (use.place & 0x1000000u) != 0u;
    precise vec2 uv = transform_uv(use.matrix, second ? a.uv.zw : a.uv.xy) + use.offset;
    vec2 dx = transform_uv(use.matrix, second ? a.uv_dx.zw : a.uv_dx.xy);
    vec2 dy = transform_uv(use.matrix, second ? a.uv_dy.zw : a.uv_dy.xy);
    return sample_array(use.place & 0xFFu, vec3(uv, float((use.place >> 8u) & 0xFFFFu)), dx, dy);
}

vec3 unit_or(vec3 v, vec3 otherwise) {
    float l = dot3(v, v);
    return l > 1e-30 && l < 1e30 ? unit(v) : otherwise;
}

// Normal mapping with the glTF convention: bitangent = w cross(normal, tangent), all three interpolated, normalised once.
vec3 shading_normal(MaterialRecord m, Attributes a) {
    if (!needs(PELLUCID_NEED_NORMALS)) return vec3(0.0, 0.0, 1.0);
    vec3 n = unit_or(a.normal, vec3(0.0, 0.0, 1.0));
    if (needs(PELLUCID_NEED_NORMAL_MAPS) && m.normal_texture.place != 0u) {
        EXACT vec3 t = sample_use(m.normal_texture, a, vec4(0.5, 0.5, 1.0, 1.0)).xyz * 2.0 - 1.0;
        EXACT vec3 bitangent = cross3(a.normal, a.tangent.xyz) * a.tangent.w;
        EXACT vec3 mapped = a.tangent.xyz * (t.x * m.normal_scale);
        mapped = mapped + bitangent * (t.y * m.normal_scale);
        mapped = mapped + a.normal * t.z;
        n = unit_or(mapped, n);
    }
    return a.front ? n : -n;
}

// rgb premultiplied by alpha, as every method composites it.
vec4 premultiply(Surface s, vec3 radiance) {
    EXACT vec3 color = min(radiance, vec3(65504.0)) * (s.premultiplied ? 1.0 : s.alpha);
    return vec4(color, s.alpha);
}

Surface load_surface(MaterialRecord m, Attributes a) {
    Surface s;
    EXACT vec4 base = m.base_color * sample_use(m.base_color_texture, a, vec4(1.0));
    if (needs(PELLUCID_NEED_VERTEX_COLORS)) base = base * a.color;
    s.discarded = needs(PELLUCID_NEED_ALPHA_MASK) && (m.flags & PELLUCID_MATERIAL_MASK) != 0u && base.a < m.alpha_cutoff;
    s.base = base.rgb;
    s.alpha = (m.flags & PELLUCID_MATERIAL_BLEND) != 0u ? clamp(base.a, 0.0, 1.0) : 1.0;
    vec4 mr = sample_use(m.metallic_roughness_texture, a, vec4(1.0));
    s.metallic = clamp(m.metallic * mr.b, 0.0, 1.0);
    s.roughness = clamp(m.roughness * mr.g, 0.0, 1.0);
    s.occlusion = 1.0;
    if (needs(PELLUCID_NEED_OCCLUSION)) {
        EXACT float o = sample_use(m.occlusion_texture, a, vec4(1.0)).r - 1.0;
        o = o * m.occlusion_strength;
        s.occlusion = 1.0 + o;
    }
    s.emissive = vec3(0.0);
    if (needs(PELLUCID_NEED_EMISSIVE)) s.emissive = m.emissive * sample_use(m.emissive_texture, a, vec4(1.0)).rgb;
    s.unlit = needs(PELLUCID_NEED_UNLIT) && (m.flags & PELLUCID_MATERIAL_UNLIT) != 0u;
    if (s.unlit) s.emissive = base.rgb;
    s.premultiplied = (m.flags & PELLUCID_MATERIAL_PREMULTIPLIED) != 0u;
    s.normal = shading_normal(m, a);
    return s;
}
#endif
