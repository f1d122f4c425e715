// SPDX-License-Identifier: MIT
// A colour chosen by two specialisation constants.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

SPEC_CONSTANT(0, RED, 1);
SPEC_CONSTANT(7, GREEN, 2);
layout(location = 0) out vec4 result;

void main() { result = vec4(float(RED), float(GREEN), RED == 5u ? 1.0 : 0.0, 255.0) / 255.0; }
