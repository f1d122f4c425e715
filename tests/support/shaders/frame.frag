// SPDX-License-Identifier: MIT
// A colour from the frame's uniforms.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

FRAME_BLOCK(Frame) { vec4 frame_color; };
layout(location = 0) out vec4 result;

void main() { result = frame_color; }
