// SPDX-License-Identifier: MIT
// IEC 61966-2-1 transfer functions.
#ifndef PELLUCID_SRGB_GLSL
#define PELLUCID_SRGB_GLSL

float srgb_encode(float c) {
    return c <= 0.0031308 ? c * 12.92 : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}
vec3 srgb_encode(vec3 c) { return vec3(srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b)); }
#endif
