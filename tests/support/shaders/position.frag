// SPDX-License-Identifier: MIT
// gl_FragCoord, unchanged.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(location = 0) out vec4 result;

void main() { result = gl_FragCoord; }
