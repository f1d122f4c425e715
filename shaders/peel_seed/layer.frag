#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A fragment more than the epsilon behind the last layer; the depth test keeps the nearest of them.
#include "common/shade_fragment.glsl"
#include "pellucid/gpu/peel_seed.h"

PASS_TEXTURE(PELLUCID_PEEL_SEED_PREVIOUS) sampler2D previous;
PASS_TEXTURE(PELLUCID_PEEL_SEED_OPAQUE) sampler2D opaque_depth;
layout(location = 0) out vec4 out_color;

void main() {
    out_color = shade_fragment();
    ivec2 at = ivec2(gl_FragCoord.xy);
    precise float moved = gl_FragCoord.z + PELLUCID_PEEL_SEED_EPSILON;
    if (moved >= texelFetch(previous, at, 0).r || gl_FragCoord.z < texelFetch(opaque_depth, at, 0).r) discard;
}
