#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The global primitive id of the nearest surface, with the alpha mask applied as the G-buffer pass applies it.
#include "common/geometry_in.glsl"

layout(location = 0) out uint out_primitive;

void main() {
    if (fragment_surface().discarded) discard;
    out_primitive = in_draw.z + uint(gl_PrimitiveID);
}
