#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The rate to beat: glTF's reflectance under point lights with nothing else.  The surface comes from the pixel's
// coordinates and one RGBA16F texel is stored; no range window, no guard for V + L = 0.
#include "common/prelude.glsl"
#include "bench_lighting/parameters.h"

SPEC_CONSTANT(0, FORM, BENCH_LIGHTING_PLAIN);
SPEC_CONSTANT(1, STORAGE, 0u);  // 1: lights come from a storage buffer

PASS_UNIFORMS(BENCH_LIGHTING_PARAMETERS, Block) { RawParameters raw; };
PASS_BUFFER_READ(BENCH_LIGHTING_LIGHTS, Lights) { RawLight stored[]; };
PASS_IMAGE(BENCH_LIGHTING_OUTPUT, rgba16f) writeonly image2D hdr;
layout(local_size_x = 16, local_size_y = 8) in;  // smaller groups take longer to start than one light takes

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(hdr)))) return;
    vec2 ndc = (vec2(at) + 0.5) * raw.pixel * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    vec3 p = vec3(ndc * raw.half_extent, -raw.distance);
    vec3 n = normalize(vec3(ndc * raw.lean, 1.0));
    vec3 v = normalize(-p);

    vec3 f0 = mix(vec3(0.04), raw.base, raw.metallic);
    vec3 diffuse = raw.base * ((1.0 - raw.metallic) * 0.318309886);
    float n_v = dot(n, v);
    float alpha = max(raw.roughness * raw.roughness, 0.002025);
    float a2 = alpha * alpha;
    float view_term = sqrt((n_v - a2 * n_v) * n_v + a2);
    vec3 sum = vec3(0.0);         // plain form
    vec3 diffuse_sum = vec3(0.0), low_sum = vec3(0.0), high_sum = vec3(0.0);  // factored form
    for (uint i = 0u; i < raw.count; ++i) {
        vec3 position = STORAGE != 0u ? stored[i].position : raw.lights[i].position;
        vec3 intensity = STORAGE != 0u ? stored[i].intensity : raw.lights[i].intensity;
        vec3 d = position - p;
        float inverse = inversesqrt(dot(d, d));
        vec3 l = d * inverse;
        float n_l = dot(n, l);
        if (n_l <= 0.0) continue;
        vec3 h = v + l;
        float hh = dot(h, h);
        vec3 c = cross(n, h);
        float light_term = sqrt((n_l - a2 * n_l) * n_l + a2);
        float x = max(1.0 - 0.5 * sqrt(hh), 0.0);
        float x2 = x * x;
        float x5 = x2 * x2 * x;
        if (FORM == BENCH_LIGHTING_PLAIN) {
            float n_h = dot(n, h);
            float q = n_h * n_h * a2 + dot(c, c);
            float ratio = hh / q;
            float distribution = ratio * ratio * a2 * 0.318309886;
            float visibility = 0.5 / (n_l * view_term + n_v * light_term);
            vec3 f = f0 + (1.0 - f0) * x5;
            sum += ((1.0 - f) * diffuse + f * (distribution * visibility)) * n_l * (intensity * (inverse * inverse));
        } else {
            // N·H = N·V + N·L; D V is one quotient; with F = F0 (1 - x⁵) + x⁵ the colours of the surface leave the
            // loop: Σ E ((1 - F) diffuse + F D V) = (1 - F0) diffuse Σ E (1 - x⁵) + F0 Σ E D V (1 - x⁵) + Σ E D V x⁵.
            float n_h = n_v + n_l;
            float q = n_h * n_h * a2 + dot(c, c);
            float specular = hh * hh * (a2 * 0.159154943) / (q * q * (n_l * view_term + n_v * light_term));
            float scale = n_l * inverse * inverse;
            float low = scale - scale * x5;
            diffuse_sum += intensity * low;
            low_sum += intensity * (low * specular);
            high_sum += intensity * (scale * x5 * specular);
        }
    }
    if (FORM != BENCH_LIGHTING_PLAIN) sum = (1.0 - f0) * diffuse * diffuse_sum + f0 * low_sum + high_sum;
    imageStore(hdr, at, vec4(sum, 1.0));
}
