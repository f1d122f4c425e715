#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Vertices of the user interface, pulled from a buffer.
#include "common/prelude.glsl"
#include "imgui_pass.h"

PASS_BUFFER_READ(PELLUCID_IMGUI_VERTICES, VertexBlock) { uint words[]; };
PUSH_BLOCK(PushBlock) { ImguiPush push; };
layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

void main() {
    uint at = uint(VERTEX_INDEX) * PELLUCID_IMGUI_VERTEX_WORDS;
    vec2 position = uintBitsToFloat(uvec2(words[at], words[at + 1u]));
    out_uv = uintBitsToFloat(uvec2(words[at + 2u], words[at + 3u]));
    out_color = unpackUnorm4x8(words[at + 4u]);
    gl_Position = vec4(position * push.place.xy + push.place.zw, 0.5, 1.0);
}
