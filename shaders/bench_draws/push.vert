// SPDX-License-Identifier: MIT
// The draw loop's vertex: one triangle placed by a matrix in push data.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

FRAME_BLOCK(Frame) { vec4 scale; };
PUSH_BLOCK(Push) { mat4 clip_from_mesh; };

void main() {
    const vec4 position = vec4(float(VERTEX_INDEX & 1), float(VERTEX_INDEX >> 1), 0.0, 1.0);
    gl_Position = clip_from_mesh * position * scale;
}
