#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A back layer over those behind it.  Samples pass where anything was left to peel: an occlusion query tells the end.
#include "common/prelude.glsl"
#include "pellucid/gpu/dual_peel.h"

PASS_TEXTURE(PELLUCID_DUAL_PEEL_RANGE) sampler2D range;
PASS_TEXTURE(PELLUCID_DUAL_PEEL_BACK) sampler2D back;
layout(location = 0) out vec4 out_color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (texelFetch(range, at, 0).r == PELLUCID_DUAL_PEEL_NONE) discard;
    out_color = texelFetch(back, at, 0);
}
