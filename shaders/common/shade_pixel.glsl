// SPDX-License-Identifier: MIT
// Lighting of one G-buffer pixel: the body of the fragment and of the compute variant, in both layouts.
#include "common/gbuffer_read.glsl"
#include "common/lighting.glsl"

vec4 shade_pixel(ivec2 at) {
    Pixel p = read_gbuffer(at);
    if (!p.covered) return vec4(frame.background, 1.0);
    Surface s = p.surface;
    EXACT vec3 radiance = s.emissive;
    if (!(needs(PELLUCID_NEED_UNLIT) && s.unlit))
        radiance = radiance + evaluate_lighting(s.base, s.metallic, s.roughness, s.occlusion, s.normal, p.position,
                                                direction_to_eye(p.position));
    return vec4(min(radiance, vec3(65504.0)), 1.0);
}
