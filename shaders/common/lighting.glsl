// SPDX-License-Identifier: MIT
// evaluate_lighting: the one lighting function, for opaque pixels and for every fragment of every transparency method.
// Lights follow KHR_lights_punctual: candela and lux, squared distance, the range window max(min(1 - (d/r)^4, 1), 0),
// and the squared smooth spot cone.
#ifndef PELLUCID_LIGHTING_GLSL
#define PELLUCID_LIGHTING_GLSL
#include "common/scene.glsl"
#include "common/brdf.glsl"

// Radiance towards the eye at the point `p` in view space.  `to_eye` is unit.
vec3 evaluate_lighting(vec3 base, float metallic, float roughness, float occlusion, vec3 normal, vec3 p, vec3 to_eye) {
    Shading s = make_shading(base, metallic, roughness, normal, to_eye);
    EXACT vec3 sum = vec3(0.0);
    if (needs(PELLUCID_NEED_AMBIENT)) sum = base * (frame.ambient * occlusion);
    if (needs(PELLUCID_NEED_DIRECTIONAL)) {
        for (uint i = 0u; i < frame.light_ends.x; ++i) {
            float n_l = dot3(normal, lights[i].to_light);
            if (n_l > 0.0) sum = sum + reflectance(s, base, metallic, lights[i].to_light, n_l) * lights[i].intensity;
        }
    }
    if (needs(PELLUCID_NEED_POINTS | PELLUCID_NEED_SPOTS)) {
        uint end = needs(PELLUCID_NEED_SPOTS) ? frame.light_ends.z : frame.light_ends.y;
        for (uint i = frame.light_ends.x; i < end; ++i) {
            LightRecord light = lights[i];
            EXACT vec3 d = light.position - p;
            EXACT float d2 = max(dot3(d, d), 1e-6);
            EXACT float inverse = inversesqrt(d2);
            EXACT vec3 l = d * inverse;
            EXACT float n_l = dot3(normal, l);
            EXACT float x = d2 * light.inverse_range_squared;
            EXACT float window = clamp(1.0 - x * x, 0.0, 1.0);
            EXACT float strength = window * inverse;
            strength = strength * inverse;
            if (needs(PELLUCID_NEED_SPOTS) && i >= frame.light_ends.y) {
                // 1 - cos = |l - axis|²/2 keeps its bits where the cosine has lost them (narrow cones).
                EXACT vec3 off = l - light.to_light;
                EXACT float cone = light.spot_edge - 0.5 * dot3(off, off);
                cone = clamp(cone * light.spot_scale, 0.0, 1.0);
                strength = strength * cone;
                strength = strength * cone;
            }
            if (n_l > 0.0 && strength > 0.0)
                sum = sum + reflectance(s, base, metallic, l, n_l) * (light.intensity * strength);
        }
    }
    return sum;
}
#endif
