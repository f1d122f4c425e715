// SPDX-License-Identifier: MIT
// Vertices as vec4 from a storage buffer, coloured by their number: triangles, strips, lines or points.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

PASS_BUFFER_READ(12, Vertices) { vec4 vertices[]; };
layout(location = 0) flat out vec4 color;

void main() {
    gl_PointSize = 1.0;
    gl_Position = vertices[VERTEX_INDEX];
    color = vec4(float(VERTEX_INDEX + 1) / 255.0, 0.0, 0.0, 1.0);
}
