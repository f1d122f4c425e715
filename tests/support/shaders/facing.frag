// SPDX-License-Identifier: MIT
// Red for front faces, green for back faces.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = gl_FrontFacing ? vec4(1, 0, 0, color.a) : vec4(0, 1, 0, color.a); }
