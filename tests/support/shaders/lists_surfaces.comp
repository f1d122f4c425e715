#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
#define LISTS_SURFACES
#include "lists.glsl"
