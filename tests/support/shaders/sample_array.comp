// SPDX-License-Identifier: MIT
// Samples a 2D array texture at (u, v, layer, lod).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 1) in;
PASS_BUFFER_READ(13, Where) { vec4 where[]; };
PASS_BUFFER(14, Found) { vec4 found[]; };
PASS_TEXTURE(12) sampler2DArray source;

void main() {
    vec4 at = where[gl_GlobalInvocationID.x];
    found[gl_GlobalInvocationID.x] = textureLod(source, at.xyz, at.w);
}
