#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define WINDOW 8
#define SORT(keys) SORT8(keys, 0)
#include "common/interleaved_select.glsl"
