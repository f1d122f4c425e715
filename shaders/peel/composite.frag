#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// All layers over what is opaque: the fixed function computes sum + through · target.
#include "common/prelude.glsl"
#include "pellucid/gpu/peel.h"

PASS_TEXTURE(PELLUCID_PEEL_SUM) sampler2D sum;
layout(location = 0) out vec4 out_color;

void main() {
    vec4 c = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
    out_color = vec4(min(c.rgb, vec3(65504.0)), c.a);
}
