// SPDX-License-Identifier: MIT
// Adds to every texel of an image, which it reads.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
PASS_IMAGE(1, r32ui) uimage2D target;
PUSH_BLOCK(Push) { uvec4 amount; };

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(target, at, uvec4(imageLoad(target, at).x + amount.x + uint(at.y * 8 + at.x)));
}
