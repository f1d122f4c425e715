// SPDX-License-Identifier: MIT
#include "common/shade_pixel.glsl"
layout(location = 0) out vec4 out_hdr;

void main() { out_hdr = shade_pixel(ivec2(gl_FragCoord.xy)); }
