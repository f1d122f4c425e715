#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The same surfaces into the classic layout, which stores the world position.
// Always the exact arithmetic: one bit here is one code of the stored normal, and a sharp highlight shows it.
#define PELLUCID_EXACT 1
#define GBUFFER_CLASSIC
#define GBUFFER_LOCATION 0
#include "common/gbuffer_write.glsl"

void main() {
    Surface s = fragment_surface();
    if (s.discarded) discard;
    write_gbuffer(s);
}
