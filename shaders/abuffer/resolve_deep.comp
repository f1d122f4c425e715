#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define WINDOW 16
#define SORT(keys) SORT16(keys, 0)
#define BITONIC(keys) BITONIC16(keys, 0)
#include "common/abuffer_resolve.glsl"
