#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Evaluates one term many times and stores the sum.  The inputs are multiples of 2^-23 that advance by a constant, so C++
// has the very same ones.
#include "common/prelude.glsl"
#include "bench_brdf/parameters.h"
#include "bench_brdf/terms.glsl"

SPEC_CONSTANT(0, TERM, BENCH_BRDF_D_INPUTS);

PASS_UNIFORMS(BENCH_BRDF_PARAMETERS, Block) { BrdfParameters bench; };
PASS_TEXTURE(BENCH_BRDF_TABLE) sampler2D table;
PASS_IMAGE(BENCH_BRDF_OUTPUT, r32f) writeonly image2D sums;
layout(local_size_x = 8, local_size_y = 8) in;

float evaluate(vec3 u) {
    vec3 n = bench.normal;
    if (TERM < BENCH_BRDF_V_INPUTS) {
        vec3 h = n + vec3(u.xy - 0.5, 0.0);
        float alpha = 0.1 + 0.9 * u.z;
        if (TERM == BENCH_BRDF_D_SEED) return d_seed(n, h, alpha);
        if (TERM == BENCH_BRDF_D_COMPLEMENT) return d_complement(n, h, alpha);
        if (TERM == BENCH_BRDF_D_LAGRANGE) return d_lagrange(n, h, alpha);
        return h.x + h.y + h.z + alpha;
    }
    if (TERM < BENCH_BRDF_E_INPUTS) {
        float n_v = 0.02 + 0.98 * u.x, n_l = 0.02 + 0.98 * u.y, alpha = 0.01 + 0.99 * u.z;
        if (TERM == BENCH_BRDF_V_EXACT) return v_exact(n_v, n_l, alpha);
        if (TERM == BENCH_BRDF_V_HAMMON) return v_hammon(n_v, n_l, alpha);
        if (TERM == BENCH_BRDF_V_UNCORRELATED) return v_uncorrelated(n_v, n_l, alpha);
        if (TERM == BENCH_BRDF_V_SCHLICK) return v_schlick(n_v, n_l, 0.5 * alpha);
        if (TERM == BENCH_BRDF_V_SEED) {  // here z is the roughness
            float r = alpha + 1.0;
            return v_schlick(n_v, n_l, r * r * 0.125);
        }
        return n_v + n_l + alpha;
    }
    vec2 place = vec2(bench.scale, bench.offset);
    if (TERM < BENCH_BRDF_MODEL_INPUTS) {
        float mu = u.x, roughness = 0.01 + 0.99 * u.y;
        vec2 e;
        if (TERM == BENCH_BRDF_E_QUADRATURE) e = e_quadrature(mu, roughness * roughness);
        else if (TERM == BENCH_BRDF_E_TABLE) e = e_table(table, place, mu, roughness).xy;
        else if (TERM == BENCH_BRDF_E_KARIS) e = e_karis(mu, roughness);
        else if (TERM == BENCH_BRDF_E_LAZAROV) e = e_lazarov(mu, roughness);
        else if (TERM == BENCH_BRDF_E_POLYNOMIAL) e = e_polynomial(mu, roughness);
        else if (TERM == BENCH_BRDF_E_CUBE) e = e_cube(mu, roughness);
        else e = vec2(mu, roughness);
        return u.z * (1.0 - e.x) + (1.0 - u.z) * e.y;
    }
    vec3 v = normalize(n + vec3(u.xy - 0.5, 0.0)), l = normalize(n + vec3(0.5 - u.z, u.x - 0.5, 0.0));
    float roughness = 0.3 + 0.7 * u.z;
    const float f0 = 0.04 + (BENCH_BRDF_BASE - 0.04) * BENCH_BRDF_METALLIC;
    const float diffuse = BENCH_BRDF_BASE * (1.0 - BENCH_BRDF_METALLIC);
    if (TERM == BENCH_BRDF_MODEL_GLTF) return model_gltf(n, v, l, roughness, f0, diffuse);
    if (TERM == BENCH_BRDF_MODEL_SEED) return model_seed(n, v, l, roughness, f0, diffuse);
    if (TERM == BENCH_BRDF_MODEL_BLINN_PHONG) return model_blinn_phong(n, v, l, roughness, f0, diffuse);
    if (TERM == BENCH_BRDF_MODEL_CONSERVING)
        return model_conserving(table, place, n, v, l, roughness, f0, diffuse);
    return v.x + v.y + v.z + l.x + l.y + l.z + roughness;
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(sums);
    if (any(greaterThanEqual(at, size))) return;
    uvec3 state = uint(at.y * size.x + at.x) * uvec3(2654435769u, 1597334677u, 3812015801u);
    float sum = 0.0;
    for (uint i = 0u; i < bench.count; ++i) {
        state += uvec3(3242174889u, 2447445413u, 860559425u);
        sum += evaluate(vec3(state >> 9u) * (1.0 / 8388608.0));
    }
    imageStore(sums, at, vec4(sum));
}
