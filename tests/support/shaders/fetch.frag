// SPDX-License-Identifier: MIT
// The texel below the pixel, of a texture as large as the target.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

PASS_TEXTURE(12) sampler2D source;
layout(location = 0) out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
