// SPDX-License-Identifier: MIT
// One triangle that covers everything, z = 0.5: draw(3).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

void main() {
    vec2 corner = vec2(float((VERTEX_INDEX & 1) * 4 - 1), float((VERTEX_INDEX >> 1) * 4 - 1));
    gl_Position = vec4(corner, 0.5, 1.0);
}
