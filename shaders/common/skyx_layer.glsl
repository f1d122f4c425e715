// SPDX-License-Identifier: MIT
// A translucent surface into the pixels of the G-buffer that the stencil leaves to it.
#define GBUFFER_LOCATION 2
#include "common/gbuffer_write.glsl"
#include "pellucid/gpu/interleaved_skyx.h"

layout(location = 0) out float out_depth;
layout(location = 1) out uint out_info;

void main() {
    Surface s = fragment_surface();
    if (s.alpha < float(PELLUCID_SKYX_LEAST_ALPHA) / 255.0) discard;
    write_gbuffer(s);
    out_depth = gl_FragCoord.z;
    uint id = PELLUCID_SKYX_OPAQUE + 1u + in_draw.w % PELLUCID_SKYX_IDS;
    precise float alpha = s.alpha * 65535.0;
    out_info = id | uint(alpha + 0.5) << 8u | PELLUCID_SKYX_TRANSLUCENT;
}
