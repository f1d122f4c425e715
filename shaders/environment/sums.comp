#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// A level of the prefiltered environment for a wide lobe: the sum over every texel of a level of the source, each with
// its solid angle and the lobe's weight at its middle.  No sample misses a sun (reference/cube_map.hpp has the errors).
#include "common/cube_map.glsl"
#include "common/prelude.glsl"
#include "pellucid/gpu/environment.h"

layout(local_size_x = PELLUCID_ENVIRONMENT_THREADS, local_size_y = PELLUCID_ENVIRONMENT_THREADS) in;
PUSH_BLOCK(Push) { EnvironmentPush lobe; };
PASS_IMAGE(PELLUCID_ENVIRONMENT_TARGET, rgba16f) writeonly imageCube target;
PASS_TEXTURE(PELLUCID_ENVIRONMENT_SOURCE) samplerCube source;

void main() {
    uvec3 at = gl_GlobalInvocationID;
    if (any(greaterThanEqual(at.xy, uvec2(lobe.size)))) return;
    vec3 axis = normalize(cube_texel_direction(at, lobe.size));
    float a2 = lobe.alpha * lobe.alpha, step = 2.0 / float(lobe.side);
    vec4 sum = vec4(0.0);
    for (uint face = 0u; face < 6u; ++face)
        for (uint y = 0u; y < lobe.side; ++y) {
            vec4 line = vec4(0.0);  // apart, so that sums of many small parts keep their digits
            for (uint x = 0u; x < lobe.side; ++x) {
                vec3 d = cube_direction(face, (vec2(x, y) + 0.5) * step - 1.0);
                float square = dot(d, d), inverse = inversesqrt(square);
                vec3 off = axis - d * inverse;
                // D(H) N·L with N = V = R: sin² of the half angle is (1 - N·L)/2.
                float sine2 = 0.25 * dot(off, off), mu = 1.0 - 2.0 * sine2;
                if (mu <= 0.0) continue;
                float q = sine2 + (1.0 - sine2) * a2;
                float weight = mu / (q * q) * (inverse * inverse * inverse);  // a texel's solid angle: area / |d|³
                line += vec4(textureLod(source, d, lobe.level).rgb, 1.0) * weight;
            }
            sum += line;
        }
    imageStore(target, ivec3(at), vec4(min(sum.rgb / sum.a, vec3(65504.0)), 1.0));
}
