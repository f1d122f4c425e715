// SPDX-License-Identifier: MIT
// Lookups of the table of gpu/dfg.h, as reference/dfg_table.hpp has them.
#ifndef PELLUCID_DFG_GLSL
#define PELLUCID_DFG_GLSL
#include "common/exact.glsl"
#include "common/prelude.glsl"
#include "pellucid/gpu/dfg.h"

SCENE_TEXTURE(PELLUCID_BIND_DFG) sampler2D dfg_table;

// What a lobe F0 D V F reflects of light from everywhere is F0 (1 - loss) + (1 - F0) bias.
struct Dfg {
    float loss, bias;
};
float dfg_fifth(float x) {
    EXACT float x2 = x * x;
    EXACT float x5 = x2 * x2;
    x5 = x5 * x;
    return x5;
}
vec4 dfg_texel(float mu, float roughness) {
    EXACT float s = root(mu);
    EXACT float x = quotient(s * (1.0 + roughness), max(s + roughness, 1e-20));
    const float scale = float(PELLUCID_DFG_SIZE - 1) / float(PELLUCID_DFG_SIZE), half_texel = 0.5 / float(PELLUCID_DFG_SIZE);
    return textureLod(dfg_table, vec2(x, roughness) * scale + half_texel, 0.0);
}
Dfg dfg_of_texel(vec4 texel, float mu) {
    EXACT float bias = (1.0 - texel.x) * dfg_fifth(1.0 - mu);
    bias = bias + texel.y;
    return Dfg(texel.x, bias);
}
// E_s of a lobe with its second one, `between` being F_ms of reference/conserving.hpp.
vec3 dfg_albedo(vec3 f0, vec3 between, Dfg dfg) {
    EXACT vec3 e = f0 * (1.0 - dfg.loss);
    e = e + (vec3(1.0) - f0) * dfg.bias;
    e = e + between * dfg.loss;
    return e;
}
#endif
