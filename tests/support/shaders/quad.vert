// SPDX-License-Identifier: MIT
// A rectangle from the draw's record: draw(6).  Counter-clockwise when x0 < x1 and y0 < y1 (NDC, y up).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

struct Quad {
    vec4 rect;  // x0, y0, x1, y1
    vec4 color;
    vec4 depth;  // x: z
    vec4 unused;
};
RECORD_BUFFER(Records) { Quad quads[]; };
layout(location = 0) flat out vec4 color;

void main() {
    const vec2 corners[6] = vec2[6](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1));
    Quad quad = quads[RECORD_INDEX];
    vec2 corner = corners[VERTEX_INDEX];
    gl_Position = vec4(corner.x == 0.0 ? quad.rect.x : quad.rect.z, corner.y == 0.0 ? quad.rect.y : quad.rect.w,
                       quad.depth.x, 1.0);
    color = quad.color;
}
