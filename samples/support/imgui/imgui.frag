#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Colour of the vertices times the texture, both display-referred, as user interfaces are blended.
#include "common/prelude.glsl"
#include "imgui_pass.h"

PASS_TEXTURE(PELLUCID_IMGUI_TEXTURE) sampler2D atlas;
layout(location = 0) in vec2 in_uv;
layout(location = 1) in vec4 in_color;
layout(location = 0) out vec4 out_color;

void main() { out_color = in_color * texture(atlas, in_uv); }
