#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of the object-sorted method: blended in draw order by the fixed function, dst = src + (1 - alpha) dst.
#include "common/shade_fragment.glsl"

layout(location = 0) out vec4 out_color;

void main() { out_color = shade_fragment(); }
