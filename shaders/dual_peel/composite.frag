#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Front layers over back layers; the fixed function adds what is behind them by what gets through.
#include "common/prelude.glsl"
#include "pellucid/gpu/dual_peel.h"

PASS_TEXTURE(PELLUCID_DUAL_PEEL_FRONT) sampler2D front;
PASS_TEXTURE(PELLUCID_DUAL_PEEL_BACK) sampler2D back;
layout(location = 0) out vec4 out_color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 f = texelFetch(front, at, 0);
    vec4 b = texelFetch(back, at, 0);
    precise float through = 1.0 - f.a;
    precise vec3 sum = f.rgb + b.rgb * through;
    out_color = vec4(min(sum, vec3(65504.0)), through * b.a);
}
