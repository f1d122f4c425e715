#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Step 2 of 4: the shader, for Vulkan and for OpenGL.  The macros of prelude.glsl are all that differs between the two.
//
// Lines where the surface bends.  Reversed depth is near / z, and 1 / z is an affine function of the pixel on any plane,
// so its second difference over three neighbours is 0 there, however steep the plane is and however far away, and not 0
// at creases and where a surface ends.
#include "common/prelude.glsl"
#include "edges.h"

PASS_IMAGE(EDGES_OUTPUT, rgba8) writeonly image2D target;
PASS_TEXTURE(EDGES_PICTURE) sampler2D picture;
PASS_TEXTURE(EDGES_DEPTH) sampler2D depth;
PUSH_BLOCK(Push) { Edges edges; };
layout(local_size_x = EDGES_GROUP_SIZE, local_size_y = EDGES_GROUP_SIZE) in;

float depth_at(ivec2 at) { return texelFetch(depth, at, 0).r; }

// In [0,2], as a share of the nearest of the three depths; 0 where nothing is.  On the picture's border it is that of the
// pixel inside.
float bend(ivec2 at, ivec2 step) {
    at = clamp(at, step, imageSize(target) - 1 - step);
    float a = depth_at(at - step), b = depth_at(at), c = depth_at(at + step);
    float nearest = max(a, max(b, c));
    return nearest > 0.0 ? abs(a + c - 2.0 * b) / nearest : 0.0;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(target)))) return;
    float bent = max(bend(at, ivec2(1, 0)), bend(at, ivec2(0, 1)));
    float line = clamp((bent - edges.threshold) / edges.softness, 0.0, 1.0) * edges.line.a;
    vec3 color = mix(texelFetch(picture, at, 0).rgb, edges.line.rgb, line);
    imageStore(target, at, vec4(floor(color * 255.0 + 0.5) * (1.0 / 255.0), 1.0));  // whole codes: a store may round
}
