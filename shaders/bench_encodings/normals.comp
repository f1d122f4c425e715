#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Unit vectors through one encoding and back (benchmarks/encodings/normals.hpp has the same on the CPU).
#include "common/prelude.glsl"
#include "common/octahedral.glsl"
#include "bench_encodings/values.glsl"

SPEC_CONSTANT(1, FORM, ENCODING_NOTHING);
SPEC_CONSTANT(2, BITS, 16u);
SPEC_CONSTANT(3, PRECISE, 0u);  // 1: the nearest of four codes is taken
SPEC_CONSTANT(4, DECODE_ONLY, 0u);  // 1: of any codes

float signed_limit() { return float((1u << (BITS - 1u)) - 1u); }
float unsigned_limit() { return float((1u << BITS) - 1u); }

// The stored word or words: 16 bits a component, however many of them are used.
uint pack_codes(vec2 codes) { return (uint(int(codes.x)) & 0xFFFFu) | (uint(int(codes.y)) << 16u); }
vec2 signed_codes(uint word) { return vec2(float(int(word << 16u) >> 16), float(int(word) >> 16)); }
vec2 unsigned_codes(uint word) { return vec2(float(word & 0xFFFFu), float(word >> 16u)); }

vec2 snorm_codes(vec2 v) { return clamp(floor(v * signed_limit() + 0.5), -signed_limit(), signed_limit()); }
vec2 unorm_codes(vec2 v) { return clamp(floor((v * 0.5 + 0.5) * unsigned_limit() + 0.5), 0.0, unsigned_limit()); }
vec2 snorm_values(uint word) { return signed_codes(word) * (1.0 / signed_limit()); }
vec2 unorm_values(uint word) { return unsigned_codes(word) * (2.0 / unsigned_limit()) - 1.0; }

vec2 octahedron(vec3 n) {
    vec2 p = n.xy * (1.0 / (abs(n.x) + abs(n.y) + abs(n.z)));
    vec2 folded = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z < 0.0 ? (1.0 - abs(p.yx)) * folded : p;
}
vec3 direction(vec2 p) {
    float z = 1.0 - abs(p.x) - abs(p.y);
    vec2 folded = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    vec3 v = vec3(z < 0.0 ? (1.0 - abs(p.yx)) * folded : p, z);
    return v * inversesqrt(dot(v, v));
}
// "Precise" rounding for any number of bits; that for 16 is the library's own.
uint nearest_codes(vec3 n) {
    vec2 low = floor(octahedron(n) * signed_limit());
    vec2 best = low;
    float closest = 8.0;
    for (int i = 0; i < 4; ++i) {
        vec2 codes = clamp(low + vec2(float(i & 1), float(i >> 1)), -signed_limit(), signed_limit());
        vec3 off = direction(codes * (1.0 / signed_limit())) - n;
        float c = dot(off, off);
        if (c < closest) {
            closest = c;
            best = codes;
        }
    }
    return pack_codes(best);
}

uvec2 encode(vec3 n) {
    if (FORM == NORMAL_UNORM_XYZ) return uvec2(pack_codes(unorm_codes(n.xy)), pack_codes(unorm_codes(n.zz)));
    if (FORM == NORMAL_SNORM_XYZ) return uvec2(pack_codes(snorm_codes(n.xy)), pack_codes(snorm_codes(n.zz)));
    if (FORM == NORMAL_HALF || FORM == NORMAL_HALF_TRUNCATED)
        return uvec2(packHalf2x16(n.xy), packHalf2x16(vec2(n.z, 0.0)));
    if (FORM == NORMAL_OCTAHEDRAL_UNORM) return uvec2(pack_codes(unorm_codes(octahedron(n))), 0u);
    if (PRECISE == 0u) return uvec2(pack_codes(snorm_codes(octahedron(n))), 0u);
    if (BITS == 16u) return uvec2(octahedral_encode(n), 0u);
    return uvec2(nearest_codes(n), 0u);
}
vec3 decode(uvec2 words) {
    if (FORM == NORMAL_UNORM_XYZ) return normalize(vec3(unorm_values(words.x), unorm_values(words.y).x));
    if (FORM == NORMAL_SNORM_XYZ) return normalize(vec3(snorm_values(words.x), snorm_values(words.y).x));
    if (FORM == NORMAL_HALF || FORM == NORMAL_HALF_TRUNCATED)
        return normalize(vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x));
    if (FORM == NORMAL_OCTAHEDRAL_UNORM) return direction(unorm_values(words.x));
    if (PRECISE != 0u && BITS == 16u) return octahedral_decode(words.x);
    return direction(snorm_values(words.x));
}
// Codes that came from nowhere, but never all 0, which is no direction; binary16 stays normal and below 1.
uvec2 any_words() {
    bool is_half = FORM == NORMAL_HALF || FORM == NORMAL_HALF_TRUNCATED;
    uint word = (is_half ? state & 0xBBFFBBFFu : state) | 0x04000400u;
    return uvec2(word, (word >> 16u) | (word << 16u));
}
vec3 through(vec3 n) {
    if (FORM == ENCODING_NOTHING) return -n;
    return decode(stored(DECODE_ONLY != 0u ? any_words() : encode(n)));
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(errors)))) return;
    begin_values(at);
    float sum = 0.0, largest = 0.0;
    for (int i = 0; i < BENCH_ENCODINGS_VALUES; ++i) {
        vec3 n = next_direction();
        vec3 off = through(n) - n;
        float square = dot(off, off);
        sum += square;
        largest = max(largest, square);
    }
    imageStore(errors, at, vec4(sum, largest, 0.0, 1.0));
}
