#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Unites the four pixels from (x, y) to (x + 1, y + 1), one of each parity, as SkyXEngine's pp_union_alpha does: sorted
// by depth (ties by their place), from the farthest on; a surface that is there already is skipped.  The bilateral
// weights that one would expect are not there.
#include "common/prelude.glsl"
#include "pellucid/gpu/interleaved_skyx.h"

SPEC_CONSTANT(2, ALPHA_GAIN, 0u);
PASS_TEXTURE(PELLUCID_SKYX_LIGHT) sampler2D light;
PASS_TEXTURE(PELLUCID_SKYX_DEPTH) sampler2D surface_depth;
PASS_TEXTURE(PELLUCID_SKYX_INFO) usampler2D info;
layout(location = 0) out vec4 out_color;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 end = textureSize(light, 0) - 1;
    ivec2 taps[4] = ivec2[](at, min(at + ivec2(0, 1), end), min(at + ivec2(1, 0), end), min(at + ivec2(1, 1), end));
    uint infos[4];
    float depths[4];
    uint any_translucent = 0u;
    uint any_opaque = 0u;
    for (int i = 0; i < 4; ++i) {
        infos[i] = texelFetch(info, taps[i], 0).r;
        depths[i] = texelFetch(surface_depth, taps[i], 0).r;
        any_translucent |= infos[i] & PELLUCID_SKYX_TRANSLUCENT;
        any_opaque |= (infos[i] & PELLUCID_SKYX_TRANSLUCENT) ^ PELLUCID_SKYX_TRANSLUCENT;
    }
    // Place of each tap, 0 the nearest.
    int places[4];
    for (int i = 0; i < 4; ++i) {
        places[i] = 0;
        for (int k = 0; k < 4; ++k)
            if (k != i && (depths[i] < depths[k] || (i > k && depths[i] == depths[k]))) ++places[i];
    }
    precise vec3 color = vec3(0.0);
    precise float alpha = 0.0;
    uint used[4] = uint[](~0u, ~0u, ~0u, ~0u);
    for (int place = 3; place >= 0; --place)
        for (int i = 0; i < 4; ++i) {
            if (places[i] != place) continue;
            uint id = infos[i] & 0xFFu;
            float a = float((infos[i] >> 8u) & 0xFFFFu) * (1.0 / 65535.0);
            vec3 c = texelFetch(light, taps[i], 0).rgb;
            if (place == 3) {
                color = c;
                alpha = a;
            } else if (id == PELLUCID_SKYX_NOTHING || (id != used[1] && id != used[2] && id != used[3])) {
                color = c * a + color * (1.0 - a);
                alpha = max(a, alpha) * (ALPHA_GAIN != 0u ? 1.1 : 1.0);
            }
            used[place] = id;
        }
    if (any_opaque != 0u && ALPHA_GAIN == 0u) alpha = 1.0;
    out_color = any_translucent == 0u ? vec4(texelFetch(light, at, 0).rgb, 1.0) : vec4(color, alpha);
}
