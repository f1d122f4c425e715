// SPDX-License-Identifier: MIT
// Three targets at once.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"

layout(location = 0) flat in vec4 color;
layout(location = 0) out vec4 first;
layout(location = 1) out uvec4 second;
layout(location = 2) out vec4 third;

void main() {
    first = color;
    second = uvec4(0xDEADBEEFu, 0u, 0u, 0u);
    third = color.wzyx;
}
