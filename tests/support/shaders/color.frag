// SPDX-License-Identifier: MIT
// The colour the vertex stage gives.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() { result = color; }
