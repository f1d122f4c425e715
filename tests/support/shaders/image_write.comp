// SPDX-License-Identifier: MIT
// Writes (x, y, 0.25, 1) / 8 into an image.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
PASS_IMAGE(0, rgba16f) writeonly image2D target;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(target, at, vec4(vec2(at), 0.25, 1.0) / 8.0);
}
