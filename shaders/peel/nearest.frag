#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Depth of the nearest fragment that the depth test lets through: blended by maximum.
layout(location = 0) out float out_depth;

void main() { out_depth = gl_FragCoord.z; }
