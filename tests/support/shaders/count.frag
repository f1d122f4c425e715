// SPDX-License-Identifier: MIT
// Counts its fragments in a storage buffer.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

PASS_BUFFER(13, Counter) { uint count; };
layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() {
    atomicAdd(count, 1u);
    result = color;
}
