#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The rate to beat: glTF's reflectance under point lights with nothing else.  The surface comes from the pixel's
// coordinates, lights from a uniform block, and one RGBA16F texel is stored.  The same formulae as the lighting pass,
// written for speed alone: no range window, no guard for V + L = 0.
#include "common/prelude.glsl"
#include "bench_lighting/parameters.h"

layout(PELLUCID_SET(1, BENCH_LIGHTING_PARAMETERS), std140) uniform Block { RawParameters raw; };
PASS_IMAGE(BENCH_LIGHTING_OUTPUT, rgba16f) writeonly image2D hdr;
layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(hdr)))) return;
    vec2 ndc = (vec2(at) + 0.5) * raw.pixel * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    vec3 p = vec3(ndc * raw.half_extent, -raw.distance);
    vec3 n = normalize(vec3(ndc * raw.lean, 1.0));
    vec3 v = normalize(-p);

    vec3 f0 = mix(vec3(0.04), raw.base, raw.metallic);
    vec3 diffuse = raw.base * ((1.0 - raw.metallic) * 0.318309886);
    float n_v = abs(dot(n, v));
    float alpha = max(raw.roughness * raw.roughness, 0.002025);
    float a2 = alpha * alpha;
    float view_term = sqrt((n_v - a2 * n_v) * n_v + a2);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < raw.count; ++i) {
        vec3 d = raw.lights[i].position - p;
        float inverse = inversesqrt(dot(d, d));
        vec3 l = d * inverse;
        float n_l = dot(n, l);
        if (n_l <= 0.0) continue;
        vec3 h = v + l;
        float hh = dot(h, h);
        vec3 c = cross(n, h);
        float n_h = dot(n, h);
        float q = n_h * n_h * a2 + dot(c, c);
        float light_term = sqrt((n_l - a2 * n_l) * n_l + a2);
        // D V as one quotient: (hh/q)² a²/π · ½ / (n_l view_term + n_v light_term).
        float specular = hh * hh * (a2 * 0.159154943) / (q * q * (n_l * view_term + n_v * light_term));
        float x = max(1.0 - 0.5 * sqrt(hh), 0.0);
        float x2 = x * x;
        vec3 f = f0 + (1.0 - f0) * (x2 * x2 * x);
        sum += ((1.0 - f) * diffuse + f * specular) * raw.lights[i].intensity * (n_l * inverse * inverse);
    }
    imageStore(hdr, at, vec4(sum, 1.0));
}
