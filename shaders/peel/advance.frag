#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Makes the nearest depth found the layer that the next passes test against.  Where a pixel is done depth stays 0: no
// fragment is behind it, so the depth test ends them all before they are shaded.  The others are counted.
#include "common/prelude.glsl"
#include "pellucid/gpu/peel.h"

SPEC_CONSTANT(2, FIRST, 0u);  // 1: nothing is composited yet, nor read
PASS_TEXTURE(PELLUCID_PEEL_NEXT) sampler2D next;
PASS_TEXTURE(PELLUCID_PEEL_OPAQUE) sampler2D opaque_depth;
PASS_TEXTURE(PELLUCID_PEEL_SUM) sampler2D sum;
PUSH_BLOCK(Push) { PeelAdvance advance; };

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(next, at, 0).r;
    if (depth < texelFetch(opaque_depth, at, 0).r) discard;
    if (FIRST == 0u && texelFetch(sum, at, 0).a <= advance.min_transmittance) discard;
    gl_FragDepth = depth;
}
