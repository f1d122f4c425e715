// SPDX-License-Identifier: MIT
// Composites the layers of a pixel, exact in coverage, order, alpha and transmittance; the light on a layer comes from the
// pixels around that lit the same surface, and where none of them fits, or where they disagree, it is computed here.
#define VISIT_IN_LOOP
#include "common/surface_node.glsl"
#include "common/list_compositor.glsl"
#include "pellucid/gpu/interleaved.h"

PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) readonly uimage2D looks;
PASS_TEXTURE(PELLUCID_INTERLEAVED_NODES) usampler2D chosen_nodes;
PASS_TEXTURE(PELLUCID_INTERLEAVED_LOOKS) usampler2D chosen_looks;
PASS_TEXTURE(PELLUCID_INTERLEAVED_LIGHT) sampler2D light;

// Largest difference of the taps, relative to their mean, up to which the mean is believed.
const float AGREEMENT = 0.06;
const float ABSOLUTE_AGREEMENT = 0.002;

// How well the surface that the pixel `q` lit stands for `s` at `p`: its instance, its distance from the plane of `s` in
// pixels, its normal, its material.
float likeness(ivec2 q, uvec4 look, Surface s, vec3 p, float pixel_size) {
    uvec4 node = texelFetch(chosen_nodes, q, 0);
    uvec4 other_look = texelFetch(chosen_looks, q, 0);
    if (node.y == 0u || look_instance(other_look) != look_instance(look)) return 0.0;
    Surface other = unpack_surface(node, other_look);
    EXACT vec3 away = view_from_depth(vec2(q) + 0.5, node_depth(node)) - p;
    EXACT float distance = quotient(abs(dot3(s.normal, away)), pixel_size);
    EXACT float turn = max(dot3(s.normal, other.normal), 0.0);
    vec3 base = abs(other.base - s.base);
    EXACT float look_difference = max(max(base.r, base.g), max(base.b, 4.0 * abs(other.roughness - s.roughness)));
    EXACT float fit = max(1.0 - distance, 0.0) * max(1.0 - 16.0 * look_difference, 0.0);
    for (int i = 0; i < 5; ++i) turn = turn * turn;  // its 32nd power
    fit = fit * turn;
    return fit;
}

vec3 light_on(uvec4 node, uvec4 look, Surface s) {
    if (s.unlit) return vec3(0.0);
    if (texelFetch(chosen_nodes, pixel, 0).xy == node.xy) return texelFetch(light, pixel, 0).rgb;
    vec3 p = view_from_depth(vec2(pixel) + 0.5, node_depth(node));
    // What a step to the next pixel is at this distance.
    EXACT float w = p.z * frame.clip_depth.z + frame.clip_depth.w;
    EXACT float pixel_size = quotient(w * frame.pixel.y, frame.clip_scale.y);
    EXACT vec3 sum = vec3(0.0);
    vec3 least = vec3(1e30);
    vec3 most = vec3(0.0);
    EXACT vec2 center = vec2(0.0);
    EXACT float total = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 step = ivec2(i % 3, i / 3) - 1;
        ivec2 q = pixel + step;
        if (step == ivec2(0) || any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, imageSize(hdr)))) continue;
        EXACT float weight = likeness(q, look, s, p, pixel_size) * (step.x == 0 || step.y == 0 ? 1.0 : 0.25);
        if (weight < 1e-3) continue;
        vec3 radiance = texelFetch(light, q, 0).rgb;
        sum = sum + radiance * weight;
        center = center + vec2(step) * weight;
        total = total + weight;
        least = min(least, radiance);
        most = max(most, radiance);
    }
    EXACT vec3 mean = sum * quotient(1.0, max(total, 1e-3));
    EXACT vec3 spread = most - least;
    // Taps on one side only extrapolate; taps that differ have an edge or a highlight between them.
    EXACT vec3 allowed = AGREEMENT * mean + ABSOLUTE_AGREEMENT;
    EXACT float off = center.x * center.x + center.y * center.y;
    EXACT float far = 0.25 * total * total;
    bool believed = total > 0.3 && off < far && all(lessThanEqual(spread, allowed));
    if (believed) return mean;
    ++tally;
    return light_surface(s, pixel, node_depth(node));
}

// The audit: surfaces lit for the pixel, the first by the lighting pass.
vec4 fragment_color(uint rank, uint place) {
    if (rank == 0u) ++tally;
    uvec4 node = imageLoad(nodes, node_texel(place));
    uvec4 look = imageLoad(looks, node_texel(place));
    Surface s = unpack_surface(node, look);
    EXACT vec3 radiance = s.emissive + light_on(node, look, s);
    return premultiply(s, radiance);
}
