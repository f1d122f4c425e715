#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define PELLUCID_EXACT 1
#define GBUFFER_CLASSIC
#include "common/skyx_layer.glsl"
