#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Adds what the volumes' lights make to the picture.
#include "common/prelude.glsl"
#include "pellucid/gpu/lighting.h"
#include "pellucid/gpu/light_volumes.h"

layout(local_size_x = PELLUCID_LIGHTING_GROUP_SIZE, local_size_y = PELLUCID_LIGHTING_GROUP_SIZE) in;
PASS_IMAGE(PELLUCID_VOLUMES_TARGET, rgba16f) image2D picture;
PASS_TEXTURE(PELLUCID_VOLUMES_SUM) sampler2D sum;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(picture)))) return;
    vec3 light = texelFetch(sum, at, 0).rgb;
    if (light == vec3(0.0)) return;
    vec4 before = imageLoad(picture, at);
    imageStore(picture, at, vec4(min(before.rgb + light, vec3(65504.0)), before.a));
}
