#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// An equirectangular picture (reference/environment.hpp says which way) as a cube map: the mean of 2 × 2 Gauss points in
// each texel, each bilinear in the picture.
#include "common/cube_map.glsl"
#include "common/prelude.glsl"
#include "pellucid/gpu/environment.h"

layout(local_size_x = PELLUCID_ENVIRONMENT_THREADS, local_size_y = PELLUCID_ENVIRONMENT_THREADS) in;
PASS_IMAGE(PELLUCID_ENVIRONMENT_TARGET, rgba32f) writeonly imageCube target;
PASS_TEXTURE(PELLUCID_ENVIRONMENT_PICTURE) sampler2D picture;
const float PI = 3.14159265358979;

vec3 texel(ivec2 at) {
    ivec2 size = textureSize(picture, 0);
    return texelFetch(picture, ivec2((at.x + size.x) % size.x, clamp(at.y, 0, size.y - 1)), 0).rgb;
}
vec3 radiance(vec3 d) {
    // The angle from the zenith between two sides, which has all its digits near the poles.
    vec2 uv = vec2(atan(d.z, d.x) / (2.0 * PI) + 0.5, atan(length(d.xz), d.y) / PI);
    vec2 at = uv * vec2(textureSize(picture, 0)) - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 f = at - vec2(first);
    return mix(mix(texel(first), texel(first + ivec2(1, 0)), f.x),
               mix(texel(first + ivec2(0, 1)), texel(first + ivec2(1, 1)), f.x), f.y);
}

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint size = uint(imageSize(target).x);
    if (any(greaterThanEqual(at.xy, uvec2(size)))) return;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i) {
        vec2 point = 0.5 + (vec2(i & 1u, i >> 1u) - 0.5) * 0.577350269;  // Gauss' two points on [0,1]
        sum += radiance(cube_direction(at.z, (vec2(at.xy) + point) * (2.0 / float(size)) - 1.0));
    }
    imageStore(target, ivec3(at), vec4(0.25 * sum, 1.0));
}
