#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Numbers and colours in [0,1] through one encoding and back (benchmarks/encodings/scalars.hpp has the same on the
// CPU).
#include "common/prelude.glsl"
#include "common/srgb.glsl"
#include "bench_encodings/values.glsl"

SPEC_CONSTANT(1, FORM, ENCODING_NOTHING);
SPEC_CONSTANT(2, BITS, 0u);  // 0: a colour, 8 bits a channel; else one number

float through_unorm(float v) {
    const float limit = float((1u << BITS) - 1u);
    uint code = uint(v * limit + 0.5);
    return float(stored(code)) * (1.0 / limit);
}
float srgb_decode(float s) {
    return s <= 0.04045 ? s * (1.0 / 12.92) : pow((s + 0.055) * (1.0 / 1.055), 2.4);
}
vec3 through_bytes(vec3 v) {
    uvec3 codes = uvec3(v * 255.0 + 0.5);
    uint word = stored(codes.x | codes.y << 8u | codes.z << 16u);
    return vec3(float(word & 0xFFu), float((word >> 8u) & 0xFFu), float(word >> 16u)) * (1.0 / 255.0);
}
vec3 through_color(vec3 c) {
    if (FORM == ENCODING_NOTHING) return -c;
    if (FORM == COLOR_LINEAR) return through_bytes(c);
    if (FORM == COLOR_GAMMA) return pow(through_bytes(pow(c, vec3(1.0 / 2.2))), vec3(2.2));
    vec3 signal = FORM == COLOR_SRGB ? srgb_encode(c) : pow(c, vec3(1.0 / 2.2));
    signal = through_bytes(signal);
    return vec3(srgb_decode(signal.r), srgb_decode(signal.g), srgb_decode(signal.b));
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(errors)))) return;
    begin_values(at);
    float sum = 0.0, largest = 0.0;
    for (int i = 0; i < BENCH_ENCODINGS_VALUES; ++i) {
        vec3 off;
        if (BITS == 0u) {
            float r = next_value(), g = next_value(), b = next_value();
            vec3 c = vec3(r, g, b);
            off = through_color(c) - c;
        } else {
            float v = next_value();
            off = vec3((FORM == ENCODING_NOTHING ? -v : through_unorm(v)) - v, 0.0, 0.0);
        }
        sum += dot(off, off);
        largest = max(largest, max(abs(off.x), max(abs(off.y), abs(off.z))));
    }
    imageStore(errors, at, vec4(sum, largest * largest, 0.0, 1.0));
}
