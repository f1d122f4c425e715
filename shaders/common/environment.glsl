// SPDX-License-Identifier: MIT
// Light from all around: a prefiltered cube map (gpu/environment.h) or the sky's table (scene/sky.hpp), and what a
// surface makes of it by the split sum (Karis 2013): prefiltered light times the lobe's directional albedo.
#ifndef PELLUCID_ENVIRONMENT_GLSL
#define PELLUCID_ENVIRONMENT_GLSL
#include "common/brdf.glsl"
#include "common/scene.glsl"

SCENE_TEXTURE(PELLUCID_BIND_ENVIRONMENT) samplerCube environment_cube;
SCENE_TEXTURE(PELLUCID_BIND_SKY) sampler2D sky_table;

// scene/sky.hpp, sample_sky_table.
vec3 sky_light(float y, float roughness) {
    const vec2 size = vec2(64.0, 16.0);
    EXACT float steps = pow(min(abs(y), 1.0), 0.3 + 0.4 * roughness);
    EXACT float column = 31.5 + sign(y) * (0.5 + 31.0 * steps);
    EXACT float row = 15.0 * pow(roughness, 0.55);
    EXACT vec2 at = min(vec2(column, row), size - 1.0);
    vec2 first = min(floor(at), size - 2.0);
    EXACT vec2 f = at - first;
    ivec2 i = ivec2(first);
    vec3 above = blend3(texelFetch(sky_table, i, 0).rgb, texelFetch(sky_table, i + ivec2(1, 0), 0).rgb, f.x);
    vec3 below = blend3(texelFetch(sky_table, i + ivec2(0, 1), 0).rgb, texelFetch(sky_table, i + ivec2(1, 1), 0).rgb, f.x);
    return blend3(above, below, f.y);
}

// Radiance around a direction in view space, prefiltered by the GGX lobe of a roughness; 1: diffuse light of a normal.
vec3 environment_light(vec3 direction, float roughness) {
    if (needs(PELLUCID_NEED_SKY)) {
        float y = dot3(vec3(frame.world_x.y, frame.world_y.y, frame.world_z.y), direction);
        return sky_light(clamp(y, -1.0, 1.0), roughness);
    }
    EXACT vec3 world = frame.world_x.xyz * direction.x;
    world = world + frame.world_y.xyz * direction.y;
    world = world + frame.world_z.xyz * direction.z;
    return textureLod(environment_cube, world, root(roughness) * frame.environment_lod).rgb;
}

// What the surface returns of it, before occlusion.
vec3 environment_radiance(Shading s, vec3 base, float metallic) {
    EXACT vec3 mirrored = s.normal * (2.0 * s.n_dot_v) - s.view;
    vec3 glossy = environment_light(mirrored, s.roughness);
    vec3 diffuse = environment_light(s.normal, 1.0);
    float mu = min(s.n_v, 1.0);
    vec4 texel = dfg_texel(mu, s.roughness);
    Dfg eye = dfg_of_texel(texel, mu);
    EXACT vec3 between = vec3(0.0);
    if (BRDF == PELLUCID_BRDF_CONSERVING) between = scattered_between(s.f0, texel.z);
    EXACT vec3 single = dfg_albedo(s.f0, vec3(0.0), eye);
    // What is scattered more than once has lost its direction: it takes diffuse light.
    EXACT vec3 several = between * eye.loss;
    EXACT vec3 rest = vec3(1.0) - single - several;
    rest = max(rest, vec3(0.0)) * base * (1.0 - metallic);
    EXACT vec3 radiance = single * glossy;
    radiance = radiance + (several + rest) * diffuse;
    return radiance;
}
#endif
