#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define WINDOW 32
#define SORT(keys) SORT32(keys, 0)
#define DEEP true
#define ABUFFER_LIT
#include "common/abuffer_resolve.glsl"
