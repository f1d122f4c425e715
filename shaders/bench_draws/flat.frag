// SPDX-License-Identifier: MIT
// The draw loop's colour: a constant whose four channels are exact in 8 bits and differ from one another.
#version 450

layout(location = 0) out vec4 color;

void main() {
    color = vec4(51.0, 102.0, 153.0, 255.0) / 255.0;
}
