#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of depth peeling: the fragments of one layer, composited behind what is there by the fixed function.  They are drawn
// the last primitive first, so that of equal depths the later one ends up in front.
#include "common/shade_fragment.glsl"
#include "pellucid/gpu/peel.h"

PASS_TEXTURE(PELLUCID_PEEL_NEXT) sampler2D next;
PASS_TEXTURE(PELLUCID_PEEL_OPAQUE) sampler2D opaque_depth;
layout(location = 0) out vec4 out_color;
layout(location = 1) out float out_count;

void main() {
    out_color = shade_fragment();
    out_count = 1.0;
    // Depth 0 also marks pixels that are done: there a fragment at the far end would come again.
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (gl_FragCoord.z != texelFetch(next, at, 0).r || gl_FragCoord.z < texelFetch(opaque_depth, at, 0).r) discard;
}
