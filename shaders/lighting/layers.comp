#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define LIGHTING_LAYERS
#include "common/lighting_compute.glsl"
