#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The next level of a cube map: weights 1 3 3 1 in both directions, across edges.  Unlike the mean of four it moves no
// light: where a sun is one texel, that decides how exact all is that is made of small levels (reference/cube_map.hpp).
#include "common/cube_map.glsl"
#include "common/prelude.glsl"
#include "pellucid/gpu/environment.h"

layout(local_size_x = PELLUCID_ENVIRONMENT_THREADS, local_size_y = PELLUCID_ENVIRONMENT_THREADS) in;
PASS_IMAGE(PELLUCID_ENVIRONMENT_TARGET, rgba32f) writeonly imageCube target;
PASS_IMAGE(PELLUCID_ENVIRONMENT_ABOVE, rgba32f) readonly imageCube above;

// Beyond an edge: the texel on its other side.
vec3 beside(ivec3 at, int side) {
    vec2 p = clamp((vec2(at.xy) + 0.5) * (2.0 / float(side)) - 1.0, -1.000001, 1.000001);
    vec3 place = cube_place(cube_direction(uint(at.z), p));
    ivec2 texel = clamp(ivec2((place.xy * 0.5 + 0.5) * float(side)), ivec2(0), ivec2(side - 1));
    return imageLoad(above, ivec3(texel, int(place.z))).rgb;
}
vec3 texel(ivec3 at, int side) {
    bvec2 outside = notEqual(clamp(at.xy, ivec2(0), ivec2(side - 1)), at.xy);
    if (!any(outside)) return imageLoad(above, at).rgb;
    if (!all(outside)) return beside(at, side);
    // Three faces meet at a corner, and the fourth texel does not exist: the mean of the three.
    ivec2 inside = clamp(at.xy, ivec2(0), ivec2(side - 1));
    return (imageLoad(above, ivec3(inside, at.z)).rgb + beside(ivec3(at.x, inside.y, at.z), side) +
            beside(ivec3(inside.x, at.y, at.z), side)) / 3.0;
}

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at.xy, imageSize(target)))) return;
    int side = imageSize(above).x;
    const float weight[4] = float[](0.125, 0.375, 0.375, 0.125);
    vec3 sum = vec3(0.0);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            sum += texel(ivec3(2 * at.xy + ivec2(i, j) - 1, at.z), side) * (weight[i] * weight[j]);
    imageStore(target, at, vec4(sum, 1.0));
}
