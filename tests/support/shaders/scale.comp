// SPDX-License-Identifier: MIT
// values[i] = values[i] * factor + offset: a storage buffer, a uniform buffer and push data.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 64) in;
PASS_UNIFORMS(12, Factor) { uvec4 factor; };
PASS_BUFFER(13, Values) { uint values[]; };
PUSH_BLOCK(Push) { uvec4 offset; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < offset.y) values[i] = values[i] * factor.x + offset.x;
}
