#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Opaque and masked surfaces into the compact layout: 12 bytes of colour targets, and emitted radiance if any is needed.
// Always the exact arithmetic: one bit here is one code of the stored normal, and a sharp highlight shows it.
#define PELLUCID_EXACT 1
#define GBUFFER_LOCATION 0
#include "common/gbuffer_write.glsl"

void main() {
    Surface s = fragment_surface();
    if (s.discarded) discard;
    write_gbuffer(s);
}
