#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// View-space point → clip → pixel and depth → view-space point, as the G-buffer stores it and lighting reads it.
#include "common/scene.glsl"

PASS_BUFFER(12, Points) { vec4 points[]; };
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= points.length()) return;
    vec4 clip = clip_position(points[i].xyz);
    precise float w = 1.0 / clip.w;
    precise vec3 ndc = clip.xyz * w;
    vec2 fragcoord = vec2((ndc.x + 1.0) / frame.pixel.x, (1.0 - ndc.y) / frame.pixel.y);
    points[i] = vec4(view_from_depth(fragcoord, ndc.z), ndc.z);
}
