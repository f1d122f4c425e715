#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of dual depth peeling (Bavoil and Myers 2008): the nearest fragment left goes behind the front layers, the farthest
// one becomes the next back layer, and those between say what is nearest and farthest in the next pass.  Everything is
// blended by maximum, so of several fragments of equal depth one remains.
#include "common/shade_fragment.glsl"
#include "pellucid/gpu/dual_peel.h"

PASS_TEXTURE(PELLUCID_DUAL_PEEL_RANGE) sampler2D range;
PASS_TEXTURE(PELLUCID_DUAL_PEEL_FRONT) sampler2D front;
layout(location = 0) out vec2 out_range;
layout(location = 1) out vec4 out_front;
layout(location = 2) out vec4 out_back;

void main() {
    vec4 color = shade_fragment();
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = gl_FragCoord.z;
    vec2 left = texelFetch(range, at, 0).rg;
    float nearest = left.x;
    float farthest = -left.y;
    out_range = vec2(PELLUCID_DUAL_PEEL_NONE);
    out_front = texelFetch(front, at, 0);
    out_back = vec4(0.0);
    if (depth < nearest && depth > farthest) out_range = vec2(depth, -depth);
    if (depth == nearest) {
        precise float through = 1.0 - out_front.a;
        precise vec3 sum = out_front.rgb + color.rgb * through;
        precise float hidden = 1.0 - through * (1.0 - color.a);
        out_front = vec4(sum, hidden);
    } else if (depth == farthest) {
        out_back = color;
    }
}
