// SPDX-License-Identifier: MIT
// What is seen through a rectangle of pixels, and whether a sphere reaches into it.  View space; perspective and
// orthographic, off centre too.
#ifndef PELLUCID_LIGHT_COLUMN_GLSL
#define PELLUCID_LIGHT_COLUMN_GLSL
#include "common/scene.glsl"

struct Column {
    vec2 lower, upper;  // NDC
};
Column column_of_pixels(uvec2 first, uvec2 end) {
    vec2 a = vec2(first) * frame.pixel.xy - 1.0, b = vec2(end) * frame.pixel.xy - 1.0;
    return Column(vec2(a.x, -b.y), vec2(b.x, -a.y));
}

// Distance of a point from the plane of all that is seen at `ndc`, one axis at a time; positive on the upper side.
vec2 beyond(vec3 e, vec2 ndc) {
    float w = e.z * frame.clip_depth.z + frame.clip_depth.w;
    vec2 normal_z = ndc * frame.clip_depth.z;
    vec2 scale = frame.clip_scale.xy;
    return (e.xy * scale + frame.clip_scale.zw - ndc * w) * inversesqrt(scale * scale + normal_z * normal_z);
}
bool in_column(Column c, vec4 sphere) {
    return all(lessThanEqual(beyond(sphere.xyz, c.upper), vec2(sphere.w))) &&
           all(greaterThanEqual(beyond(sphere.xyz, c.lower), vec2(-sphere.w)));
}

// Also against the box around the part of the column between two depths, far < near <= 0: planes alone let spheres pass
// that are near an edge.
bool in_slab(Column c, vec4 sphere, float far, float near) {
    vec2 w = vec2(far, near) * frame.clip_depth.z + frame.clip_depth.w;
    vec2 scale = frame.view_scale.xy, offset = frame.clip_scale.zw;
    vec2 a = (c.lower * w.x - offset) * scale, b = (c.lower * w.y - offset) * scale;
    vec2 d = (c.upper * w.x - offset) * scale, e = (c.upper * w.y - offset) * scale;
    vec3 lower = vec3(min(min(a, b), min(d, e)), far), upper = vec3(max(max(a, b), max(d, e)), near);
    vec3 off = sphere.xyz - clamp(sphere.xyz, lower, upper);
    return dot(off, off) <= sphere.w * sphere.w;
}
#endif
