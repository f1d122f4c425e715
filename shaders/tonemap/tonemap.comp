#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The last pass: exposure, tone curve, sRGB encoding.  Curves as in include/pellucid/reference/tonemap.hpp.  The curve is
// a constant of the pipeline: a driver that masks instead of branching would otherwise compute all of them.
#include "common/prelude.glsl"
#include "common/srgb.glsl"
#include "pellucid/gpu/scene.h"
#include "pellucid/gpu/tonemap.h"

SPEC_CONSTANT(2, CURVE, PELLUCID_TONEMAP_NEUTRAL);
FRAME_BLOCK(FrameBlock) { FrameParams frame; };
PASS_TEXTURE(PELLUCID_TONEMAP_INPUT) sampler2D hdr;
PASS_IMAGE(PELLUCID_TONEMAP_OUTPUT, rgba8) writeonly image2D display;
layout(local_size_x = PELLUCID_TONEMAP_GROUP_SIZE, local_size_y = PELLUCID_TONEMAP_GROUP_SIZE) in;

// Khronos PBR Neutral: exact base colour below 0.76, C1, hue kept.
vec3 neutral(vec3 c) {
    const float start = 0.76;
    const float desaturation = 0.15;
    float low = min(c.r, min(c.g, c.b));
    c -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start) return c;
    const float d = 1.0 - start;
    float new_peak = 1.0 - d * d / (peak + d - start);
    c *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(c, vec3(new_peak), g);
}

// Narkowicz 2015, fit of the ACES reference transform.
vec3 aces(vec3 c) {
    return (c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14);
}

// AgX (Sobotka), sigmoid as Wrensch's sixth-order polynomial; log2 range -12.47393 … 4.026069.
vec3 agx(vec3 c) {
    const mat3 inset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051,
                            0.0784335999999992, 0.878468636469772, 0.0784336,
                            0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438,
                             -0.0980208811401368, 1.15190312990417, -0.0980434501171241,
                             -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    c = inset * c;
    vec3 x = clamp((log2(max(c, vec3(1e-10))) + 12.47393) / (4.026069 + 12.47393), 0.0, 1.0);
    vec3 x2 = x * x;
    vec3 x4 = x2 * x2;
    x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    return pow(max(outset * x, vec3(0.0)), vec3(2.2));
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(display)))) return;
    // NaN becomes 0 and infinity the largest value: one bad pixel stays one pixel.  Before the exposure, so that it does
    // not matter whether a bright value overflowed its target.
    vec3 c = texelFetch(hdr, at, 0).rgb;
    c = vec3(c.r > 0.0 ? min(c.r, 65504.0) : 0.0, c.g > 0.0 ? min(c.g, 65504.0) : 0.0,
             c.b > 0.0 ? min(c.b, 65504.0) : 0.0);
    c *= frame.exposure;
    if (CURVE == PELLUCID_TONEMAP_REINHARD) c = c / (c + 1.0);
    else if (CURVE == PELLUCID_TONEMAP_NEUTRAL) c = neutral(c);
    else if (CURVE == PELLUCID_TONEMAP_ACES) c = aces(c);
    else if (CURVE == PELLUCID_TONEMAP_AGX) c = agx(c);
    // Rounded here: how a store rounds to eight bits is a device's own affair.
    imageStore(display, at, vec4(floor(srgb_encode(clamp(c, 0.0, 1.0)) * 255.0 + 0.5) * (1.0 / 255.0), 1.0));
}
