#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// What no lighting pass can be quicker than: all that a pixel of the G-buffer stores is read, as the lighting pass reads
// it, and one RGBA16F texel is stored.
#include "common/gbuffer_read.glsl"
#include "pellucid/gpu/lighting.h"
layout(local_size_x = PELLUCID_LIGHTING_GROUP_SIZE, local_size_y = PELLUCID_LIGHTING_GROUP_SIZE) in;
PASS_IMAGE(PELLUCID_LIGHTING_OUTPUT, rgba16f) writeonly image2D hdr;

// Numbers that binary16 holds, of every target.
vec4 everything(Stored s) {
    float base = s.base.r + s.base.g + s.base.b + s.base.a;
    return vec4(float(s.normal & 0x7FFu), float(s.material & 0x7FFu), base + s.depth, 1.0);
}

void main() {
    const ivec2 tile = ivec2(PELLUCID_LIGHTING_GROUP_SIZE, PELLUCID_LIGHTING_GROUP_SIZE * PELLUCID_LIGHTING_PIXELS);
    ivec2 size = imageSize(hdr), at = ivec2(gl_WorkGroupID.xy) * tile + ivec2(gl_LocalInvocationID.xy);
    Stored stored = fetch_gbuffer(min(at, size - 1));
    for (int i = 0; i < PELLUCID_LIGHTING_PIXELS; ++i) {
        ivec2 below = at + ivec2(0, PELLUCID_LIGHTING_GROUP_SIZE);
        Stored next = fetch_gbuffer(min(below, size - 1));
        if (any(greaterThanEqual(at, size))) return;
        imageStore(hdr, at, everything(stored));
        at = below;
        stored = next;
    }
}
