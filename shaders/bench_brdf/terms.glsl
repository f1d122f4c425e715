// SPDX-License-Identifier: MIT
// Terms of reflection models and their approximations, as include/pellucid/reference and benchmarks/brdf/forms.hpp have
// them.  F0 and colours are scalars: what a channel costs more is the same for all.
#ifndef PELLUCID_BENCH_BRDF_TERMS_GLSL
#define PELLUCID_BENCH_BRDF_TERMS_GLSL

const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;

float fifth(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

// ---------------------------------------------------------------- D.  h: V + L, not normalised
float d_seed(vec3 n, vec3 h, float alpha) {
    float n_h = dot(n, h) * inversesqrt(dot(h, h)), a2 = alpha * alpha;
    float inner = n_h * n_h * (a2 - 1.0) + 1.0;
    return a2 / (PI * inner * inner);
}
float d_complement(vec3 n, vec3 h, float alpha) {
    float n_h = dot(n, h) * inversesqrt(dot(h, h)), a = n_h * alpha;
    float k = alpha / (1.0 - n_h * n_h + a * a);
    return k * k * INV_PI;
}
float d_lagrange(vec3 n, vec3 h, float alpha) {
    vec3 c = cross(n, h);
    float scaled = dot(n, h) * alpha;
    float ratio = alpha * dot(h, h) / (dot(c, c) + scaled * scaled);
    return ratio * ratio * INV_PI;
}

// ---------------------------------------------------------------- V
float v_exact(float n_v, float n_l, float alpha) {
    float a2 = alpha * alpha;
    return 0.5 / (n_l * sqrt((n_v - a2 * n_v) * n_v + a2) + n_v * sqrt((n_l - a2 * n_l) * n_l + a2));
}
float v_hammon(float n_v, float n_l, float alpha) {
    return 0.5 / mix(2.0 * n_l * n_v, n_l + n_v, alpha);
}
float v_uncorrelated(float n_v, float n_l, float alpha) {
    float a2 = alpha * alpha;
    return 1.0 / ((n_v + sqrt((n_v - a2 * n_v) * n_v + a2)) * (n_l + sqrt((n_l - a2 * n_l) * n_l + a2)));
}
float v_schlick(float n_v, float n_l, float k) {
    return 0.25 / ((n_v * (1.0 - k) + k) * (n_l * (1.0 - k) + k));
}

// ---------------------------------------------------------------- E: vec2(loss, bias)
// Gauss' rule of 8 points on [0,1].
const float NODES[8] = float[](0.019855071751232, 0.101666761293187, 0.237233795041836, 0.408282678752175,
                               0.591717321247825, 0.762766204958164, 0.898333238706813, 0.980144928248768);
const float WEIGHTS[8] = float[](0.050614268145188, 0.111190517226687, 0.156853322938944, 0.181341891689181,
                                 0.181341891689181, 0.156853322938944, 0.111190517226687, 0.050614268145188);

// reference/dfg.hpp, integrate_dfg.
vec2 e_quadrature(float mu, float alpha) {
    float a2 = alpha * alpha;
    float sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    float stretched = sqrt(a2 * sine * sine + mu * mu);
    if (stretched <= 0.0) return vec2(0.0, 1.0);
    float wx = alpha * sine / stretched, wz = mu / stretched;
    float root_v = sqrt((mu - a2 * mu) * mu + a2);
    float k = 1.0 + sine, numerator = 2.0 * a2 * mu * k, top = 1.0 + wz;
    float none_below = numerator / (stretched * (k * k + a2 * mu * mu));
    float all_above = min(numerator / (stretched * (mu * mu + a2 * k * k)), top);
    float scale = 0.0, bias = 0.0;
    for (int panel = 0; panel < 2; ++panel) {
        float lower = panel == 0 ? none_below : all_above;
        float width = (panel == 0 ? all_above : top) - lower;
        if (width <= 0.0) continue;
        for (int i = 0; i < 8; ++i) {
            float t = NODES[i];
            float h = lower + width * (panel == 0 ? t * t : t * t * t), z = h - wz;
            float weight_h = WEIGHTS[i] * (panel == 0 ? 2.0 * t : 3.0 * t * t) * width / top;
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
                float c = cos(first + (last - first) * NODES[j]);
                float length2 = base + swing * c;
                float n_l = min((a + b * c) / length2, 1.0);
                if (!(n_l > 0.0)) continue;
                float v_h = (sine * alpha * (s * c + wx) + mu * h) * inversesqrt(length2);
                float root_l = sqrt((n_l - a2 * n_l) * n_l + a2);
                float share = (mu + root_v) * n_l / (n_l * root_v + mu * root_l);
                float fresnel = fifth(1.0 - clamp(v_h, 0.0, 1.0));
                float weight = weight_h * WEIGHTS[j] * (last - first) * INV_PI * share;
                scale += weight * (1.0 - fresnel);
                bias += weight * fresnel;
            }
        }
    }
    float loss = max(1.0 - (scale + bias), 0.0);
    return vec2(loss, min(bias, 1.0 - loss));
}
// `place`: half a texel and the size, as parameters.h says.  zw: the averages of the row.
vec4 e_table(sampler2D table, vec2 place, float mu, float roughness) {
    float s = sqrt(mu);
    float x = s * (1.0 + roughness) / max(s + roughness, 1e-20);
    vec4 t = textureLod(table, vec2(x, roughness) * place.x + place.y, 0.0);
    return vec4(t.x, t.y + (1.0 - t.x) * fifth(1.0 - mu), t.zw);
}
vec2 loss_and_bias(float scale, float bias) {
    return vec2(1.0 - scale - bias, bias);
}
vec2 e_karis(float mu, float roughness) {
    const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
    const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
    vec4 r = roughness * c0 + c1;
    float a = min(r.x * r.x, exp2(-9.28 * mu)) * r.x + r.y;
    return loss_and_bias(r.z - 1.04 * a, r.w + 1.04 * a);
}
vec2 e_lazarov(float mu, float roughness) {
    vec4 t = (1.0 - roughness) * vec4(0.5745, 1.548, -0.02397, 1.301) + vec4(0.5753, -0.2511, -0.02066, 0.4755);
    float bias = clamp(t.x * min(t.y, exp2(-7.672 * mu)) + t.z, 0.0, 1.0);
    return loss_and_bias(clamp(t.w, 0.0, 1.0) - bias, bias);
}
vec2 e_polynomial(float mu, float roughness) {
    float x = 1.0 - roughness, y = mu;
    float bias = min(x * (1.895 * x - 0.1688), 0.9903 + y * (-4.853 + y * (8.404 - 5.069 * y)));
    bias = clamp(bias, 0.0, 1.0);
    float delta = 0.6045 + x * (1.699 + x * (-3.603 + 2.661 * x) + 1.404 * y) + y * (-0.5228 + 0.1939 * y);
    return loss_and_bias(clamp(delta, 0.0, 1.0) - bias, bias);
}
vec2 e_cube(float mu, float roughness) {
    float x = 1.0 - max(roughness, mu);
    return vec2(-x * x * x, x * x * x);
}

// ---------------------------------------------------------------- models: f(v, l) N·L
float model_gltf(vec3 n, vec3 v, vec3 l, float roughness, float f0, float diffuse) {
    float n_l = dot(n, l), n_v = abs(dot(n, v)), alpha = max(roughness * roughness, 0.002025);
    vec3 h = v + l;
    float f = f0 + (1.0 - f0) * fifth(max(1.0 - 0.5 * sqrt(dot(h, h)), 0.0));
    return ((1.0 - f) * diffuse * INV_PI + f * d_lagrange(n, h, alpha) * v_exact(n_v, n_l, alpha)) * n_l;
}
float model_seed(vec3 n, vec3 v, vec3 l, float roughness, float f0, float diffuse) {
    float n_l = dot(n, l), n_v = max(dot(n, v), 0.0);
    vec3 h = normalize(v + l);
    float k = (roughness + 1.0) * (roughness + 1.0) * 0.125;
    float g = n_v / (n_v * (1.0 - k) + k) * (n_l / (n_l * (1.0 - k) + k));
    float f = f0 + (1.0 - f0) * fifth(clamp(1.0 - max(dot(h, v), 0.0), 0.0, 1.0));
    float d = d_seed(n, h, roughness * roughness);
    return ((1.0 - f) * diffuse * INV_PI + f * d * g / (4.0 * n_v * n_l + 0.0001)) * n_l;
}
float model_blinn_phong(vec3 n, vec3 v, vec3 l, float roughness, float f0, float diffuse) {
    float n_l = dot(n, l), alpha = max(roughness * roughness, 0.002025), p = 2.0 / (alpha * alpha);
    vec3 h = v + l, c = cross(n, h);
    float sin2 = min(dot(c, c) / dot(h, h), 0.9999999);
    float lobe = exp((0.5 * p - 1.0) * log(1.0 - sin2)) * p * (0.125 * INV_PI);
    return (diffuse * INV_PI + f0 * lobe) * n_l;
}
float model_conserving(sampler2D table, vec2 place, vec3 n, vec3 v, vec3 l, float roughness, float f0, float diffuse) {
    float n_l = min(dot(n, l), 1.0), n_v = min(abs(dot(n, v)), 1.0);
    roughness = max(roughness, 0.045);
    float alpha = roughness * roughness;
    // What a pixel does once.
    vec4 eye = e_table(table, place, n_v, roughness);
    vec2 average = eye.zw;
    float mean = f0 + (1.0 - f0) * (1.0 / 21.0);
    float between = mean * mean * (1.0 - average.x) / (1.0 - mean * average.x);
    float eye_left = 1.0 - (f0 * (1.0 - eye.x) + (1.0 - f0) * eye.y + between * eye.x);
    float average_left = 1.0 - (f0 * (1.0 - average.x) + (1.0 - f0) * average.y + between * average.x);
    float diffuse_scale = diffuse * eye_left * INV_PI / max(average_left, 1e-6);
    float between_scale = average.x > 0.0 ? between * eye.x * INV_PI / average.x : 0.0;
    // What it does for every light.
    vec2 light = e_table(table, place, n_l, roughness).xy;
    float left = 1.0 - (f0 * (1.0 - light.x) + (1.0 - f0) * light.y + between * light.x);
    vec3 h = v + l;
    float f = f0 + (1.0 - f0) * fifth(max(1.0 - 0.5 * sqrt(dot(h, h)), 0.0));
    float lobe = f * d_lagrange(n, h, alpha) * v_exact(n_v, n_l, alpha);
    return (diffuse_scale * left + lobe + between_scale * light.x) * n_l;
}
#endif
