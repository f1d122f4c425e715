#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A level of the prefiltered environment for a narrow lobe, by importance sampling (Karis 2013) of levels whose texels
// are as large as a sample's share (Krivanek and Colbert 2008): reference/importance_sampling.hpp.  alpha = 0: a copy.
#include "common/cube_map.glsl"
#include "common/prelude.glsl"
#include "pellucid/gpu/environment.h"

layout(local_size_x = PELLUCID_ENVIRONMENT_THREADS, local_size_y = PELLUCID_ENVIRONMENT_THREADS) in;
PUSH_BLOCK(Push) { EnvironmentPush lobe; };
PASS_IMAGE(PELLUCID_ENVIRONMENT_TARGET, rgba16f) writeonly imageCube target;
PASS_TEXTURE(PELLUCID_ENVIRONMENT_SOURCE) samplerCube source;
const float PI = 3.14159265358979;

void main() {
    uvec3 at = gl_GlobalInvocationID;
    if (any(greaterThanEqual(at.xy, uvec2(lobe.size)))) return;
    vec3 axis = normalize(cube_texel_direction(at, lobe.size));
    if (lobe.alpha == 0.0) {
        imageStore(target, ivec3(at), vec4(min(textureLod(source, axis, lobe.level).rgb, vec3(65504.0)), 1.0));
        return;
    }
    // Duff et al. 2017.
    float sign_z = axis.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (sign_z + axis.z), b = axis.x * axis.y * a;
    vec3 tangent = vec3(1.0 + sign_z * axis.x * axis.x * a, sign_z * b, -sign_z * axis.x);
    vec3 bitangent = vec3(b, sign_z + axis.y * axis.y * a, -axis.y);
    float a2 = lobe.alpha * lobe.alpha, share = 1.0 / (1.0 + a2);  // of half vectors within 45 degrees
    const float count = float(PELLUCID_ENVIRONMENT_SAMPLES);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < uint(PELLUCID_ENVIRONMENT_SAMPLES); ++i) {
        float x = (float(i) + 0.5) / count * share, phi = 2.0 * PI * float(bitfieldReverse(i) >> 8u) * (1.0 / 16777216.0);
        float t = lobe.alpha * sqrt(x / (1.0 - x)), cosine = inversesqrt(1.0 + t * t), sine = t * cosine;
        float sine2 = sine * sine, mu = 1.0 - 2.0 * sine2;
        if (mu <= 0.0) continue;
        float ratio = lobe.alpha / (sine2 + (1.0 - sine2) * a2);
        float density = ratio * ratio * (1.0 + a2) / (4.0 * PI);
        float lod = max(0.5 * log2(6.0 * float(lobe.side * lobe.side) / (4.0 * PI * count * density)) + 0.5, 0.0);
        vec2 h = vec2(cos(phi), sin(phi)) * (2.0 * cosine * sine);
        vec3 l = tangent * h.x + bitangent * h.y + axis * mu;
        sum += vec4(textureLod(source, l, lod).rgb, 1.0) * mu;
    }
    imageStore(target, ivec3(at), vec4(min(sum.rgb / sum.a, vec3(65504.0)), 1.0));
}
