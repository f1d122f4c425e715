#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Counts the fragments of each pixel that the depth test lets through: blended by addition, exact up to 2^24.
layout(location = 0) out float out_one;

void main() { out_one = 1.0; }
