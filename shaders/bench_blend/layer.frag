// SPDX-License-Identifier: MIT
// The baseline of transparency: one constant colour, blended by the fixed function.
#version 450

layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 color;

void main() {
    color = in_color;
}
