#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// One triangle that covers the target; no vertex buffer.
#include "common/prelude.glsl"

void main() {
    vec2 p = vec2(float((VERTEX_INDEX << 1) & 2), float(VERTEX_INDEX & 2));
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
}
