#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Opaque and masked surfaces of a scene in which no light falls on any of them: what they emit is the picture.
#include "common/geometry_in.glsl"

layout(location = 0) out vec4 out_radiance;

void main() {
    Surface s = fragment_surface();
    if (s.discarded) discard;
    out_radiance = vec4(min(s.emissive, vec3(65504.0)), 1.0);
}
