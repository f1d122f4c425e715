// SPDX-License-Identifier: MIT
// A colour from the scene group; the pass group is empty.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

SCENE_BUFFER_READ(24, Scene) { vec4 scene_color; };
layout(location = 0) out vec4 result;

void main() { result = scene_color; }
