// SPDX-License-Identifier: MIT
// Samples a cube texture at (direction, lod).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 1) in;
PASS_BUFFER_READ(13, Where) { vec4 where[]; };
PASS_BUFFER(14, Found) { vec4 found[]; };
PASS_TEXTURE(12) samplerCube source;

void main() {
    vec4 at = where[gl_GlobalInvocationID.x];
    found[gl_GlobalInvocationID.x] = textureLod(source, at.xyz, at.w);
}
