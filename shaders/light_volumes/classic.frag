#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define GBUFFER_CLASSIC
#include "common/light_volume.glsl"
