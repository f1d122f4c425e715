// SPDX-License-Identifier: MIT
// What the kernels of benchmarks/encodings and their callers agree upon.  The forms are the values of C++ enumerations.
#ifndef PELLUCID_BENCH_ENCODINGS_PARAMETERS_H
#define PELLUCID_BENCH_ENCODINGS_PARAMETERS_H
#include "pellucid/gpu/types.h"

#define BENCH_ENCODINGS_OUTPUT 0   // storage image, rgba32f: sum and largest of the squared errors of an invocation
#define BENCH_ENCODINGS_MATRIX 12  // uniform block: EncodingMatrix
#define BENCH_ENCODINGS_VALUES 256

// Every kernel: nothing is encoded, and the value comes back with the other sign, so that the loop stays.
#define ENCODING_NOTHING 0u

#define NORMAL_UNORM_XYZ 1u
#define NORMAL_SNORM_XYZ 2u
#define NORMAL_HALF 3u  // and 4: how packHalf2x16 rounds is the device's affair
#define NORMAL_HALF_TRUNCATED 4u
#define NORMAL_OCTAHEDRAL_SNORM 5u
#define NORMAL_OCTAHEDRAL_UNORM 6u

#define COLOR_SRGB 1u
#define COLOR_LINEAR 2u
#define COLOR_GAMMA 3u
#define COLOR_GAMMA_SRGB 4u
#define SCALAR_UNORM 5u

#define POSITION_WORLD_FLOAT 1u
#define POSITION_WORLD_HALF 2u  // and 3
#define POSITION_WORLD_HALF_TRUNCATED 3u
#define POSITION_DEPTH24 4u
#define POSITION_DEPTH32F 5u
#define POSITION_RELATIVE 0u
#define POSITION_INVERSE_MATRIX 1u
#define POSITION_ADDED_TO_THE_CAMERA 2u

// Points are seen from 0.1 m to 10^4 times that: exp2 of [0, 13.28771) times the first.
#define BENCH_ENCODINGS_NEAR 0.1
#define BENCH_ENCODINGS_OCTAVES 13.28771

PELLUCID_GPU_BEGIN
struct EncodingMatrix {
    vec4 x, y, z, w;  // columns of world_from_clip
};
PELLUCID_GPU_SIZE(EncodingMatrix, 64)
PELLUCID_GPU_END
#endif
