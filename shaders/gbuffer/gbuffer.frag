#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Opaque and masked surfaces into the compact layout: 12 bytes of colour targets, and emitted radiance if any is needed.
// Always the exact arithmetic: one bit here is one code of the stored normal, and a sharp highlight shows it.
#define PELLUCID_EXACT 1
#include "common/gbuffer.glsl"
#include "common/geometry_in.glsl"

layout(location = 0) out uint out_normal;
layout(location = 1) out vec4 out_base;
layout(location = 2) out uint out_material;
layout(location = 3) out vec4 out_emissive;

void main() {
    Surface s = fragment_surface();
    if (s.discarded) discard;
    out_normal = octahedral_encode(s.normal);
    out_base = vec4(s.base, s.occlusion);
    out_material = pack_material(s.roughness, s.metallic, surface_flags(s));
    out_emissive = vec4(min(s.emissive, vec3(65504.0)), 1.0);
}
