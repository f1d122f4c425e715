#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Rebuilds the G-buffer's surface from primitive ids alone and packs it as the compact layout does.
#include "common/gbuffer.glsl"
#include "common/primitive.glsl"
#include "common/srgb.glsl"

PASS_TEXTURE(12) usampler2D primitives;
PASS_BUFFER(13, Texels) { GBufferTexel texels[]; };
PUSH_BLOCK(Push) { uvec4 first_record; } push;
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = textureSize(primitives, 0);
    if (any(greaterThanEqual(at, size))) return;
    uint primitive = texelFetch(primitives, at, 0).r;
    GBufferTexel texel = GBufferTexel(0u, 0u, 0.0, 0u);
    if (primitive != PELLUCID_NO_PRIMITIVE) {
        uint material;
        Attributes a = rebuild_attributes(push.first_record.x, primitive, at, material);
        Surface s = load_surface(materials[material], a);
        texel.normal = octahedral_encode(s.normal);
        texel.material = pack_material(s.roughness, s.metallic, surface_flags(s));
        texel.base = packUnorm4x8(vec4(srgb_encode(clamp(s.base, 0.0, 1.0)), s.occlusion));
        texel.depth = 1.0;
    }
    texels[at.y * size.x + at.x] = texel;
}
