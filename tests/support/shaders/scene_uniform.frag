// SPDX-License-Identifier: MIT
// The sum of a colour of the scene group and one of the pass group, in a uniform buffer.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

PASS_UNIFORMS(13, Pass) { vec4 pass_color; };
SCENE_BUFFER_READ(24, Scene) { vec4 scene_color; };
layout(location = 0) out vec4 result;

void main() { result = scene_color + pass_color; }
