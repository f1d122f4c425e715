// SPDX-License-Identifier: MIT
// One fragment of a translucent surface, lit by the same function as opaque pixels: what every transparency method
// sinks.  rgb is premultiplied by alpha.
#ifndef PELLUCID_SHADE_FRAGMENT_GLSL
#define PELLUCID_SHADE_FRAGMENT_GLSL
#include "common/geometry_in.glsl"
#include "common/lighting.glsl"

vec4 shade_fragment() {
    Surface s = fragment_surface();
    EXACT vec3 radiance = s.emissive;
    if (!s.unlit) {
        vec3 p = view_from_depth(gl_FragCoord.xy, gl_FragCoord.z);
        radiance = radiance + evaluate_lighting(s.base, s.metallic, s.roughness, s.occlusion, s.normal,
                                                lit_point(ivec2(gl_FragCoord.xy), p, s.normal, true));
    }
    return premultiply(s, radiance);
}
#endif
