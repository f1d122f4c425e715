#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Makes the table of directional albedo: a workgroup a row, a thread a texel.  Line by line integrate_dfg of
// reference/dfg.hpp, over the normals that the eye sees (Heitz 2014; spherical caps: Dupuy and Benyoub 2023), and the
// averages of reference/dfg_table.hpp.
#include "common/prelude.glsl"
#include "pellucid/gpu/dfg.h"

layout(local_size_x = PELLUCID_DFG_SIZE) in;
PASS_IMAGE(PELLUCID_DFG_TABLE, rgba16f) writeonly image2D table;
shared vec2 row[PELLUCID_DFG_SIZE];   // loss, shift
shared vec2 part[PELLUCID_DFG_SIZE];  // of the averages
const float PI = 3.14159265358979;
// Gauss' rules of 8 and of 4 points on [0,1]; the other halves mirror them.
const float NODES[4] = float[](0.019855071751232, 0.101666761293187, 0.237233795041836, 0.408282678752175);
const float WEIGHTS[4] = float[](0.050614268145188, 0.111190517226687, 0.156853322938944, 0.181341891689181);
const float CELL_NODES[2] = float[](0.069431844202974, 0.330009478207572);
const float CELL_WEIGHTS[2] = float[](0.173927422568727, 0.326072577431273);

float node(int i) { return i < 4 ? NODES[i] : 1.0 - NODES[7 - i]; }
float weight(int i) { return WEIGHTS[i < 4 ? i : 7 - i]; }
float fifth(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

vec2 loss_and_bias(float mu, float alpha) {
    float a2 = alpha * alpha;
    float sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    float stretched = sqrt(a2 * sine * sine + mu * mu);
    if (stretched <= 0.0) return vec2(0.0, 1.0);
    float wx = alpha * sine / stretched, wz = mu / stretched;
    float root_v = sqrt((mu - a2 * mu) * mu + a2);
    float k = 1.0 + sine, numerator = 2.0 * a2 * mu * k, top = 1.0 + wz;
    float none_below = numerator / (stretched * (k * k + a2 * mu * mu));
    float all_above = min(numerator / (stretched * (mu * mu + a2 * k * k)), top);
    precise float scale = 0.0, bias = 0.0;  // the same bits on every API
    for (int panel = 0; panel < 2; ++panel) {
        float lower = panel == 0 ? none_below : all_above;
        float width = (panel == 0 ? all_above : top) - lower;
        if (width <= 0.0) continue;
        for (int i = 0; i < 8; ++i) {
            float t = node(i);
            float h = lower + width * (panel == 0 ? t * t : t * t * t), z = h - wz;
            float weight_h = weight(i) * (panel == 0 ? 2.0 * t : 3.0 * t * t) * width / top;
            float s = sqrt(max((1.0 - z) * (1.0 + z), 0.0));
            float base = a2 * (s * s + wx * wx) + h * h, swing = 2.0 * a2 * s * wx;
            float a = 2.0 * (sine * alpha * wx + mu * h) * h - mu * base;
            float b = 2.0 * sine * alpha * s * h - mu * swing;
            float first = 0.0, last = PI;
            if (panel == 0) {
                float sets = acos(clamp(-a / b, -1.0, 1.0));
                if (b > 0.0) last = sets;
                else first = sets;
            }
            for (int j = 0; j < 8; ++j) {
                float c = cos(first + (last - first) * node(j));
                float length2 = base + swing * c;
                float n_l = min((a + b * c) / length2, 1.0);
                if (!(n_l > 0.0)) continue;
                float v_h = (sine * alpha * (s * c + wx) + mu * h) * inversesqrt(length2);
                float root_l = sqrt((n_l - a2 * n_l) * n_l + a2);
                float share = (mu + root_v) * n_l / (n_l * root_v + mu * root_l);  // G2/G1
                float fresnel = fifth(1.0 - clamp(v_h, 0.0, 1.0));
                float w = weight_h * weight(j) * (last - first) / PI * share;
                scale += w * (1.0 - fresnel);
                bias += w * fresnel;
            }
        }
    }
    precise float loss = max(1.0 - (scale + bias), 0.0);
    return vec2(loss, min(bias, 1.0 - loss));
}

float cosine(float x, float roughness) {
    float s = x * roughness / ((1.0 - x) + roughness);
    return s * s;
}

void main() {
    const float last = float(PELLUCID_DFG_SIZE - 1);
    uint column = gl_LocalInvocationID.x;
    float roughness = max(float(gl_WorkGroupID.x) / last, PELLUCID_DFG_MIN_ROUGHNESS);
    float mu = cosine(float(column) / last, roughness);
    vec2 e = loss_and_bias(mu, roughness * roughness);
    row[column] = vec2(e.x, e.y - (1.0 - e.x) * fifth(1.0 - mu));
    barrier();
    // 2 ∫ E μ dμ over the cell from this texel to the next, of what a lookup there gives.
    precise vec2 sum = vec2(0.0);
    if (column + 1u < uint(PELLUCID_DFG_SIZE)) {
        for (int i = 0; i < 4; ++i) {
            float f = i < 2 ? CELL_NODES[i] : 1.0 - CELL_NODES[3 - i];
            float x = (float(column) + f) / last, rest = (1.0 - x) + roughness;
            float s = x * roughness / rest;
            float slope = roughness * (1.0 + roughness) / (rest * rest);
            float w = CELL_WEIGHTS[i < 2 ? i : 3 - i] / last * 4.0 * s * s * s * slope;
            vec2 t = mix(row[column], row[column + 1u], f);
            sum += w * vec2(t.x, t.y + (1.0 - t.x) * fifth(1.0 - s * s));
        }
    }
    part[column] = sum;
    barrier();
    for (uint step = uint(PELLUCID_DFG_SIZE) / 2u; step > 0u; step /= 2u) {
        if (column < step) part[column] += part[column + step];
        barrier();
    }
    imageStore(table, ivec2(column, gl_WorkGroupID.x), vec4(row[column], part[0]));
}
