// SPDX-License-Identifier: MIT
// The reflectance models, in the forms of include/pellucid/reference/brdf.hpp.  All vectors are unit.
#ifndef PELLUCID_BRDF_GLSL
#define PELLUCID_BRDF_GLSL
#include "common/dfg.glsl"
#include "pellucid/gpu/scene.h"

SPEC_CONSTANT(1, BRDF, PELLUCID_BRDF_GLTF);

const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;
// Smallest GGX alpha for punctual lights (roughness 0.045): below it a point light's highlight is a delta that no pixel
// can resolve.
const float MIN_ROUGHNESS = 0.045;
const float MIN_ALPHA = 0.002025;

// What of the surface and the eye is the same for every light.
struct Shading {
    vec3 normal;
    vec3 view;
    vec3 f0;
    vec3 diffuse;  // (1 - metallic) base / pi
    float n_dot_v;
    float n_v;     // |N·V|
    float alpha2;  // GGX alpha squared
    float view_term;  // sqrt(N·V² (1 - a²) + a²), Smith's lambda for V
    float roughness;
    // Conserving only.
    float loss;     // (1 - E(N·V)) / (pi (1 - E average))
    vec3 between;   // F_ms
    float punctual_roughness;  // the lobe's
};

// F_ms of reference/conserving.hpp: what the lobe of F0 returns of light that it scatters more than once.
vec3 scattered_between(vec3 f0, float average_loss) {
    EXACT vec3 mean = f0 + (vec3(1.0) - f0) * (1.0 / 21.0);
    EXACT vec3 above = mean * mean * (1.0 - average_loss);
    EXACT vec3 below = vec3(1.0) - mean * average_loss;
    return vec3(quotient(above.r, below.r), quotient(above.g, below.g), quotient(above.b, below.b));
}

// The conserving model's diffuse factor and second lobe: reference/conserving.hpp (Kulla and Conty 2017; the diffuse part
// Kelemen and Szirmay-Kalos 2001).
void conserve(inout Shading s, vec3 base, float metallic) {
    EXACT float roughness = max(s.roughness, MIN_ROUGHNESS);
    s.punctual_roughness = roughness;
    vec4 texel = dfg_texel(min(s.n_v, 1.0), roughness);
    Dfg eye = dfg_of_texel(texel, min(s.n_v, 1.0)), average = Dfg(texel.z, texel.w);
    vec3 between = scattered_between(s.f0, average.loss);
    s.between = between;
    EXACT float loss = average.loss > 0.0 ? quotient(eye.loss * INV_PI, average.loss) : 0.0;
    s.loss = loss;
    EXACT vec3 left = max(vec3(1.0) - dfg_albedo(s.f0, between, eye), vec3(0.0));
    EXACT vec3 average_left = max(vec3(1.0) - dfg_albedo(s.f0, between, average), vec3(1e-6));
    EXACT vec3 diffuse = base * ((1.0 - metallic) * INV_PI);
    diffuse = diffuse * vec3(quotient(left.r, average_left.r), quotient(left.g, average_left.g),
                             quotient(left.b, average_left.b));
    s.diffuse = diffuse;
}

Shading make_shading(vec3 base, float metallic, float roughness, vec3 normal, vec3 view) {
    Shading s;
    s.normal = normal;
    s.view = view;
    s.f0 = blend3(vec3(0.04), base, metallic);
    EXACT vec3 d = base * (1.0 - metallic);
    s.diffuse = d * INV_PI;
    s.n_dot_v = dot3(normal, view);
    s.n_v = abs(s.n_dot_v);
    EXACT float a = max(roughness * roughness, MIN_ALPHA);
    s.alpha2 = a * a;
    EXACT float k = s.n_v - s.alpha2 * s.n_v;
    k = k * s.n_v;
    s.view_term = root(k + s.alpha2);
    s.roughness = roughness;
    s.loss = 0.0;
    s.between = vec3(0.0);
    s.punctual_roughness = roughness;
    if (BRDF == PELLUCID_BRDF_CONSERVING) conserve(s, base, metallic);
    return s;
}

// What lights add up to, before the surface's colours.  F = F0 (1 - x) + x with x = (1 - V·H)^5 does not depend on the
// light's colour, nor F0 and the diffuse colour on the light, so three sums of light are all that a loop keeps:
// sum (1 - F) diffuse + D V F = diffuse (1 - F0) unreflected + F0 normal + grazing.
struct LightSum {
    vec3 unreflected;  // sum of (1 - x) E N·L; models that are not taken apart: the whole sum; conserving: of E N·L
    vec3 normal;       // sum of (1 - x) D V E N·L
    vec3 grazing;      // sum of x D V E N·L
    vec3 lost;         // conserving: sum of E N·L times what the lobe loses towards the light
    vec3 biased;       // conserving: the same of the lobe of F0 = 0
};
LightSum no_light() { return LightSum(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)); }

// glTF's metallic-roughness model, or the conserving one, under a light of `illuminance` E at normal incidence: Trowbridge–Reitz D in the form
// q = |N×H|² + (N·H a)², which does not cancel near the peak (Lagrange's identity); height-correlated Smith V (Heitz
// 2014); Schlick F; diffuse (1 - F) rho/pi.  h = V + L is not normalised: D V is one quotient with |h|⁴ above.
void add_ggx(inout LightSum sum, Shading s, vec3 l, float n_l, vec3 illuminance) {
    EXACT vec3 h = s.view + l;
    EXACT float hh = dot3(h, h);
    if (hh < 1e-12) return;
    EXACT vec3 c = cross3(s.normal, h);
    EXACT float nh = s.n_dot_v + n_l;
    EXACT float q = nh * nh;
    q = q * s.alpha2;
    q = q + dot3(c, c);
    EXACT float k = n_l - s.alpha2 * n_l;
    k = k * n_l;
    EXACT float light_term = root(k + s.alpha2);
    EXACT float denominator = n_l * s.view_term;
    denominator = denominator + s.n_v * light_term;
    denominator = denominator * q * q;
    EXACT float lobe = hh * hh * (s.alpha2 * (0.5 * INV_PI));
    // Only where V + L all but vanishes on the horizon is the product smaller than a float can be.
    lobe = quotient(lobe, max(denominator, 1e-37));
    EXACT float x = max(1.0 - 0.5 * root(hh), 0.0);
    EXACT float x2 = x * x;
    EXACT float x5 = x2 * x2;
    x5 = x5 * x;
    EXACT vec3 grazing = illuminance * (n_l * x5);
    EXACT vec3 all = illuminance * n_l;
    EXACT vec3 normal = all - grazing;
    if (BRDF == PELLUCID_BRDF_CONSERVING) {
        float mu = min(n_l, 1.0);
        Dfg light = dfg_of_texel(dfg_texel(mu, s.punctual_roughness), mu);
        sum.unreflected = sum.unreflected + all;
        sum.lost = sum.lost + all * light.loss;
        sum.biased = sum.biased + all * light.bias;
    } else {
        sum.unreflected = sum.unreflected + normal;
    }
    sum.normal = sum.normal + normal * lobe;
    sum.grazing = sum.grazing + grazing * lobe;
}

// The source document's own terms, kept to be measured: NoH²(a² - 1) + 1, Schlick's G with k = (r + 1)²/8, and an
// epsilon in the denominator.  Its guards are its own; roughness 0 is not finite.
vec3 reflect_seed(Shading s, vec3 base, float metallic, vec3 l, float n_l) {
    EXACT vec3 sum = s.view + l;
    if (dot3(sum, sum) < 1e-12) return vec3(0.0);
    vec3 h = unit(sum);
    float a = s.roughness * s.roughness;
    float a2 = a * a;
    float n_h = max(dot3(s.normal, h), 0.0);
    EXACT float inner = n_h * n_h * (a2 - 1.0) + 1.0;
    float d = quotient(a2, PI * inner * inner);
    float n_v = max(dot3(s.normal, s.view), 0.0);
    EXACT float k = (s.roughness + 1.0) * (s.roughness + 1.0) * 0.125;
    float g = quotient(n_v, n_v * (1.0 - k) + k) * quotient(n_l, n_l * (1.0 - k) + k);
    EXACT float x = clamp(1.0 - max(dot3(h, s.view), 0.0), 0.0, 1.0);
    EXACT float x5 = x * x * x * x * x;
    EXACT vec3 f = s.f0 + (vec3(1.0) - s.f0) * x5;
    EXACT vec3 kd = (vec3(1.0) - f) * (1.0 - metallic);
    EXACT vec3 r = kd * base * INV_PI + f * quotient(d * g, 4.0 * n_v * n_l + 0.0001);
    return r * n_l;
}

// Blinn–Phong in radiometric units: diffuse (1 - metallic) base/pi, specular F0 (s + 2)/(8 pi) (N·H)^s with
// s = 2/a² - 2, whose peak is that of GGX.  (N·H)^s = exp(s/2 log(1 - |N×H|²)): near the axis N·H has no digits left.
vec3 reflect_blinn_phong(Shading s, vec3 l, float n_l) {
    EXACT vec3 h = s.view + l;
    EXACT float hh = dot3(h, h);
    EXACT vec3 r = s.diffuse;
    if (hh >= 1e-12 && dot3(s.normal, h) > 0.0) {
        EXACT vec3 c = cross3(s.normal, h);
        EXACT float sin2 = min(quotient(dot3(c, c), hh), 0.9999999);
        EXACT float series = sin2 * (1.0 / 3.0) + 0.5;
        series = series * sin2 + 1.0;
        series = -(series * sin2);
        EXACT float logarithm = sin2 < 0.01 ? series : log(1.0 - sin2);
        EXACT float p = quotient(2.0, s.alpha2);
        EXACT float lobe = exp((0.5 * p - 1.0) * logarithm);
        lobe = lobe * p * (0.125 * INV_PI);
        r = r + s.f0 * lobe;
    }
    return r * n_l;
}

// Adds a light to what was summed so far.  `l`: towards it; N·L > 0.
void add_light(inout LightSum sum, Shading s, vec3 base, float metallic, vec3 l, float n_l, vec3 illuminance) {
    if (BRDF == PELLUCID_BRDF_GLTF || BRDF == PELLUCID_BRDF_CONSERVING) {
        add_ggx(sum, s, l, n_l, illuminance);
    } else {
        EXACT vec3 r = BRDF == PELLUCID_BRDF_SEED ? reflect_seed(s, base, metallic, l, n_l)
                                                  : reflect_blinn_phong(s, l, n_l);
        EXACT vec3 total = sum.unreflected + r * illuminance;
        sum.unreflected = total;
    }
}

// The radiance that the surface makes of it.
vec3 reflected(LightSum sum, Shading s) {
    if (BRDF == PELLUCID_BRDF_SEED || BRDF == PELLUCID_BRDF_BLINN_PHONG) return sum.unreflected;
    EXACT vec3 other = vec3(1.0) - s.f0;
    EXACT vec3 r = other * s.diffuse;
    r = r * sum.unreflected;
    if (BRDF == PELLUCID_BRDF_CONSERVING) {
        // 1 - E_s(N·L) = (1 - F0) + (F0 - F_ms) loss - (1 - F0) bias, summed.
        EXACT vec3 rest = (s.f0 - s.between) * sum.lost - other * sum.biased;
        r = r + s.diffuse * rest;
        r = r + s.between * (sum.lost * s.loss);
    }
    r = r + s.f0 * sum.normal;
    r = r + sum.grazing;
    return r;
}
#endif
