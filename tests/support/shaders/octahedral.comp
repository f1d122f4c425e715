#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// code = encode(direction), direction' = decode(code), for every direction of a buffer.
#include "common/prelude.glsl"
#include "common/octahedral.glsl"

PASS_BUFFER(12, Directions) { vec4 directions[]; };
layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= directions.length()) return;
    uint code = octahedral_encode(directions[i].xyz);
    directions[i] = vec4(octahedral_decode(code), uintBitsToFloat(code));
}
