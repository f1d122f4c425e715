#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A back layer over those behind it; where there is none it is 0 and changes nothing.
#include "common/prelude.glsl"
#include "pellucid/gpu/dual_peel.h"

PASS_TEXTURE(PELLUCID_DUAL_PEEL_BACK) sampler2D back;
layout(location = 0) out vec4 out_color;

void main() { out_color = texelFetch(back, ivec2(gl_FragCoord.xy), 0); }
