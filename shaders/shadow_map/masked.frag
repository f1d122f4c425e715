#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Masked surfaces in a shadow map: only the holes matter.
// Always the exact arithmetic, so that maps are equal bit for bit between APIs.
#define PELLUCID_EXACT 1
#include "common/geometry_in.glsl"

void main() {
    if (fragment_surface().discarded) discard;
}
