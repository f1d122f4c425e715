// SPDX-License-Identifier: MIT
// evaluate_lighting: the one lighting function, for opaque pixels and for every fragment of every transparency method.
// Lights follow KHR_lights_punctual: candela and lux, squared distance, the range window max(min(1 - (d/r)^4, 1), 0),
// and the squared smooth spot cone.
#ifndef PELLUCID_LIGHTING_GLSL
#define PELLUCID_LIGHTING_GLSL
#include "common/environment.glsl"
#include "common/light_lists.glsl"
#include "common/shadow.glsl"

// What a lit point is, beside how it reflects.
struct LitPoint {
    vec3 p;       // view space
    vec3 to_eye;  // unit
    vec3 plane;   // unit normal of the surface that shadows fall on
    uvec2 lists;  // lights_at
};
// Translucent surfaces cast no shadow, so none of their own can fall on them: their shading normal will do for `plane`.
LitPoint lit_point(ivec2 pixel, vec3 p, vec3 plane, bool translucent) {
    return LitPoint(p, direction_to_eye(p), plane, lights_at(pixel, p, translucent));
}

// Adds light `i`: of a point or spot light exactly nothing where its range or cone ends.
void add_light_at(inout LightSum sum, uint i, Shading s, vec3 base, float metallic, vec3 p, vec3 plane) {
    LightRecord light = light_record(i);
    EXACT vec3 d = vec3(0.0);
    EXACT vec3 l = light.to_light;
    EXACT float strength = 1.0;
    if (!needs(PELLUCID_NEED_DIRECTIONAL) || i >= frame.light_ends.x) {
        d = light.position - p;
        EXACT float d2 = max(dot3(d, d), 1e-6);
        EXACT float inverse = inversesqrt(d2);
        l = d * inverse;
        strength = inverse;
        if (needs(PELLUCID_NEED_LIGHT_RANGES)) {
            EXACT float x = d2 * light.inverse_range_squared;
            EXACT float window = clamp(1.0 - x * x, 0.0, 1.0);
            strength = window * inverse;
        }
        strength = strength * inverse;
        if (needs(PELLUCID_NEED_SPOTS) && light.spot_scale > 0.0) {
            // 1 - cos = |l - axis|²/2 keeps its bits where the cosine has lost them (narrow cones).
            EXACT vec3 off = l - light.to_light;
            EXACT float cone = light.spot_edge - 0.5 * dot3(off, off);
            cone = clamp(cone * light.spot_scale, 0.0, 1.0);
            strength = strength * cone;
            strength = strength * cone;
        }
    }
    float n_l = dot3(s.normal, l);
    if (!(n_l > 0.0 && strength > 0.0)) return;
    EXACT vec3 illuminance = light.intensity * strength;
    if (needs(PELLUCID_NEED_SHADOWS)) illuminance = illuminance * shadow_light(i, p, plane, -d);
    add_light(sum, s, base, metallic, l, n_l, illuminance);
}

// Adds the lights whose bits both lists have: of 32 words that one word summarises, then of 32 lights a word.
void add_listed_lights(inout LightSum sum, Shading s, vec3 base, float metallic, LitPoint at) {
    uint summaries = frame.light_grid.w;
    for (uint summary = 0u; summary < summaries; ++summary) {
        uint words = light_word(at.lists, summary);
        while (words != 0u) {
            uint word = summary * 32u + uint(findLSB(words));
            words &= words - 1u;
            uint bits = light_word(at.lists, summaries + word);
            while (bits != 0u) {
                uint i = frame.light_ends.x + word * 32u + uint(findLSB(bits));
                bits &= bits - 1u;
                add_light_at(sum, i, s, base, metallic, at.p, at.plane);
            }
        }
    }
}

// Radiance towards the eye of a surface at a point.
vec3 evaluate_lighting(vec3 base, float metallic, float roughness, float occlusion, vec3 normal, LitPoint at) {
    Shading s = make_shading(base, metallic, roughness, normal, at.to_eye);
    LightSum sum = no_light();
    // Drivers inline what a light does at every place that asks for it, and that is most of what they compile: all
    // lights that no list has are added in one place, directional ones first, as they are stored.
    bool listed = needs(PELLUCID_NEED_LIGHT_TILES | PELLUCID_NEED_LIGHT_CLUSTERS);
    if (!listed || needs(PELLUCID_NEED_DIRECTIONAL)) {
        uint end = listed ? frame.light_ends.x : at.lists.y;
        for (uint i = 0u; i < end; ++i) add_light_at(sum, i, s, base, metallic, at.p, at.plane);
    }
    if (listed) add_listed_lights(sum, s, base, metallic, at);
    EXACT vec3 radiance = reflected(sum, s);
    if (needs(PELLUCID_NEED_AMBIENT)) radiance = radiance + base * (frame.ambient * occlusion);
    if (needs(PELLUCID_NEED_SKY | PELLUCID_NEED_ENVIRONMENT))
        radiance = radiance + environment_radiance(s, base, metallic) * occlusion;
    return radiance;
}
#endif
