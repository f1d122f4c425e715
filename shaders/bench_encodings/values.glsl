// SPDX-License-Identifier: MIT
// The values that a kernel encodes, and what it makes of the errors.  C++ repeats the sequence (encodings/checks.hpp).
#ifndef PELLUCID_BENCH_ENCODINGS_VALUES_GLSL
#define PELLUCID_BENCH_ENCODINGS_VALUES_GLSL
#include "bench_encodings/parameters.h"

PASS_IMAGE(BENCH_ENCODINGS_OUTPUT, rgba32f) writeonly image2D errors;
layout(local_size_x = 8, local_size_y = 8) in;

uint state;
uint nothing;  // 0, which no compiler can know
void begin_values(ivec2 at) {
    uint width = uint(imageSize(errors).x);
    state = (uint(at.y) * width + uint(at.x)) * 0x9E3779B9u + 1u;
    nothing = width >> 24u;
}
// A stored word.  Some drivers take unpackHalf2x16(packHalf2x16(v)) for v, as if nothing were stored between them.
uint stored(uint word) { return word ^ nothing; }
uvec2 stored(uvec2 words) { return uvec2(stored(words.x), stored(words.y)); }

// Uniform in [0,1): the upper 24 bits of a linear congruential generator (Numerical Recipes).
float next_value() {
    state = state * 1664525u + 1013904223u;
    return float(state >> 8u) * 5.9604644775390625e-8;
}
// Unit vectors in all directions: points of a cube, normalised.
vec3 next_direction() {
    float x = next_value(), y = next_value(), z = next_value();
    vec3 v = vec3(x, y, z) * 2.0 - 1.0;
    return v * inversesqrt(max(dot(v, v), 1e-12));
}
#endif
