#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The baseline of transparency: a rectangle that covers the picture, with its colour from the draw's record.
#include "common/prelude.glsl"

struct Layer {
    vec4 color;  // premultiplied
    vec4 place;  // half extent in normalised device coordinates, depth, unused
};
RECORD_BUFFER(Layers) { Layer layers[]; };
layout(location = 0) flat out vec4 out_color;

void main() {
    Layer layer = layers[RECORD_INDEX];
    // Corners of two triangles, counter-clockwise.
    int corner = VERTEX_INDEX < 3 ? VERTEX_INDEX : (VERTEX_INDEX == 3 ? 0 : VERTEX_INDEX - 2);
    vec2 sign = vec2(corner == 1 || corner == 2 ? 1.0 : -1.0, corner >= 2 ? 1.0 : -1.0);
    gl_Position = vec4(sign * layer.place.xy, layer.place.z, 1.0);
    out_color = layer.color;
}
