// SPDX-License-Identifier: MIT
// The draw loop's vertex: one triangle placed by the matrix in the draw's own record.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

FRAME_BLOCK(Frame) { vec4 scale; };
struct DrawRecord {
    mat4 clip_from_mesh;
    vec4 unused[4];
};
RECORD_BUFFER(Records) { DrawRecord records[]; };

void main() {
    const vec4 position = vec4(float(VERTEX_INDEX & 1), float(VERTEX_INDEX >> 1), 0.0, 1.0);
    gl_Position = records[RECORD_INDEX].clip_from_mesh * position * scale;
}
