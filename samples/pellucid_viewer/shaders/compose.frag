#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The left picture up to the split, the right one behind it: codes are copied as they are.  Nothing is where a picture
// does not reach.
#include "common/prelude.glsl"
#include "compose.h"

PASS_TEXTURE(PELLUCID_COMPOSE_LEFT) sampler2D left;
PASS_TEXTURE(PELLUCID_COMPOSE_RIGHT) sampler2D right;
PUSH_BLOCK(PushBlock) { ComposePush push; };
layout(location = 0) out vec4 out_color;

void main() {
    uvec2 at = uvec2(gl_FragCoord.xy) - push.corner;
    bool is_left = at.x < push.split;
    uvec2 texel = at / (is_left ? push.left_divisor : push.right_divisor);
    // A divisor leaves pixels over at the right and the lower edge.
    ivec2 end = (is_left ? textureSize(left, 0) : textureSize(right, 0)) - 1;
    ivec2 from = min(ivec2(texel), end);
    out_color = is_left ? texelFetch(left, from, 0) : texelFetch(right, from, 0);
}
