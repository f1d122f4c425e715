#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The same surfaces into the classic layout, which stores the world position.
// Always the exact arithmetic: one bit here is one code of the stored normal, and a sharp highlight shows it.
#define PELLUCID_EXACT 1
#include "common/gbuffer.glsl"
#include "common/geometry_in.glsl"

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_base;
layout(location = 3) out vec4 out_material;
layout(location = 4) out vec4 out_emissive;

void main() {
    Surface s = fragment_surface();
    if (s.discarded) discard;
    EXACT vec3 world = world_from_view(view_from_depth(gl_FragCoord.xy, gl_FragCoord.z)) + frame.camera_position;
    out_position = vec4(world, 1.0);
    out_normal = vec4(s.normal, 0.0);
    out_base = vec4(s.base, 1.0);
    out_material = vec4(s.metallic, s.roughness, s.occlusion, float(surface_flags(s)) * (1.0 / 255.0));
    out_emissive = vec4(min(s.emissive, vec3(65504.0)), 1.0);
}
