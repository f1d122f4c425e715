#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Copies what is opaque into the depth buffer of the layers, for the pixels of one parity, which the stencil marks.
#include "common/prelude.glsl"
#include "pellucid/gpu/interleaved_skyx.h"

PASS_TEXTURE(PELLUCID_SKYX_DEPTH) sampler2D opaque_depth;
PUSH_BLOCK(Push) { SkyxMark mark; };
layout(location = 0) out float out_depth;
layout(location = 1) out uint out_info;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(opaque_depth, at, 0).r;
    gl_FragDepth = depth;
    out_depth = depth;
    out_info = (depth != 0.0 ? PELLUCID_SKYX_OPAQUE : PELLUCID_SKYX_NOTHING) | 0xFFFF00u;
    if ((at.x & 1) != int(mark.parity.x) || (at.y & 1) != int(mark.parity.y)) discard;
}
