// SPDX-License-Identifier: MIT
// Writes arguments of indirect work: two indexed draws, then one dispatch.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 1) in;
PASS_BUFFER(12, Arguments) { uint words[]; };
PUSH_BLOCK(Push) { uvec4 first; };  // x: base instance of the first draw

void main() {
    words[0] = 6u; words[1] = 1u; words[2] = 0u; words[3] = 0u; words[4] = first.x;
    words[5] = 6u; words[6] = 1u; words[7] = 0u; words[8] = 0u; words[9] = first.x + 1u;
    words[10] = 2u; words[11] = 1u; words[12] = 1u;
}
