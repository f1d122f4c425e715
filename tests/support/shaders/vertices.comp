// SPDX-License-Identifier: MIT
// Writes the corners of two triangles that cover the left half of the picture.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 1) in;
PASS_BUFFER(12, Vertices) { vec4 vertices[]; };

void main() {
    vertices[0] = vec4(-1.0, -3.0, 0.5, 1.0);
    vertices[1] = vec4(0.0, -3.0, 0.5, 1.0);
    vertices[2] = vec4(0.0, 5.0, 0.5, 1.0);
    vertices[3] = vec4(-1.0, -3.0, 0.5, 1.0);
    vertices[4] = vec4(0.0, 5.0, 0.5, 1.0);
    vertices[5] = vec4(-1.0, 5.0, 0.5, 1.0);
}
