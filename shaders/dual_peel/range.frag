#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Nearest and farthest fragment of all: blended by maximum.
layout(location = 0) out vec2 out_range;

void main() { out_range = vec2(gl_FragCoord.z, -gl_FragCoord.z); }
