// SPDX-License-Identifier: MIT
// A colour from push data: the sum of the block's eight vectors.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

PUSH_BLOCK(Push) { vec4 parts[8]; };
layout(location = 0) out vec4 result;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) sum += parts[i];
    result = sum;
}
