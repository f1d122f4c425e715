#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The vertex stage of passes that only ask where surfaces are.
#include "common/scene.glsl"

invariant gl_Position;
precise gl_Position;

void main() { gl_Position = clip_position(view_position(records[RECORD_INDEX], vertices[VERTEX_INDEX].position)); }
