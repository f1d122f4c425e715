#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The G-buffer's depth once more, with a stencil buffer beside it: the G-buffer's own is read while volumes are drawn.
#include "common/prelude.glsl"
#include "pellucid/gpu/gbuffer.h"

PASS_TEXTURE(PELLUCID_GBUFFER_DEPTH) sampler2D gbuffer_depth;

void main() { gl_FragDepth = texelFetch(gbuffer_depth, ivec2(gl_FragCoord.xy), 0).r; }
