// SPDX-License-Identifier: MIT
// Lighting of one G-buffer pixel: the body of the fragment and of the compute variant, in both layouts.
#include "common/gbuffer_read.glsl"
#include "common/lighting.glsl"
#if defined(LIGHTING_LAYERS)
#include "common/surface_node.glsl"
#include "pellucid/gpu/interleaved.h"
#endif

vec3 background_radiance(ivec2 at) {
    if (!needs(PELLUCID_NEED_BACKDROP)) return frame.background;
    // Any depth will do: the direction of a ray is the same all along it.
    vec3 p = view_from_depth(vec2(at) + 0.5, 0.5);
    return min(environment_light(-direction_to_eye(p), 0.0), vec3(65504.0));
}

vec4 shade_pixel(ivec2 at, Stored stored) {
    Pixel p = decode_gbuffer(at, stored);
    if (!p.covered) return vec4(background_radiance(at), 1.0);
    Surface s = p.surface;
    EXACT vec3 radiance = s.emissive;
    if (!(needs(PELLUCID_NEED_UNLIT) && s.unlit))
        radiance = radiance + evaluate_lighting(s.base, s.metallic, s.roughness, s.occlusion, s.normal,
                                                lit_point(at, p.position, p.plane, false));
    return vec4(min(radiance, vec3(65504.0)), 1.0);
}

#if defined(LIGHTING_LAYERS)
PASS_TEXTURE(PELLUCID_INTERLEAVED_NODES) usampler2D chosen_nodes;
PASS_TEXTURE(PELLUCID_INTERLEAVED_LOOKS) usampler2D chosen_looks;

// Light on the one translucent surface of the pixel, by the same function; 0 where there is none.
vec4 shade_layer(ivec2 at) {
    uvec4 node = texelFetch(chosen_nodes, at, 0);
    if (node.y == 0u) return vec4(0.0);
    Surface s = unpack_surface(node, texelFetch(chosen_looks, at, 0));
    return vec4(min(light_surface(s, at, node_depth(node)), vec3(65504.0)), 1.0);
}
#endif
