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
    // Depth 0 also marks pixels that are done: there a fragment at the far end would come again.  It adds nothing (and is
    // not discarded: where a shader may discard, Mesa's software drivers blend what the depth test has refused, too).
    ivec2 at = ivec2(gl_FragCoord.xy);
    bool in_layer =
        gl_FragCoord.z == texelFetch(next, at, 0).r && gl_FragCoord.z >= texelFetch(opaque_depth, at, 0).r;
    out_color = in_layer ? shade_fragment() : vec4(0.0);
    out_count = in_layer ? 1.0 : 0.0;
}
