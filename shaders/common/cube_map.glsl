// SPDX-License-Identifier: MIT
// Cube maps as Vulkan and OpenGL define them (Vulkan 1.3, "Cube Map Face Selection"; OpenGL 4.5, "Cube Map Texture
// Selection"), as in reference/cube_map.hpp.
#ifndef PELLUCID_CUBE_MAP_GLSL
#define PELLUCID_CUBE_MAP_GLSL

// Not unit; `at` in [-1,1]² of the face.
vec3 cube_direction(uint face, vec2 at) {
    switch (face) {
        case 0u: return vec3(1.0, -at.y, -at.x);
        case 1u: return vec3(-1.0, -at.y, at.x);
        case 2u: return vec3(at.x, 1.0, at.y);
        case 3u: return vec3(at.x, -1.0, -at.y);
        case 4u: return vec3(at.x, -at.y, 1.0);
        default: return vec3(-at.x, -at.y, -1.0);
    }
}
vec3 cube_texel_direction(uvec3 texel, uint size) {
    return cube_direction(texel.z, (vec2(texel.xy) + 0.5) * (2.0 / float(size)) - 1.0);
}
// Face in z, place on it in [-1,1]².
vec3 cube_place(vec3 r) {
    vec3 m = abs(r);
    if (m.z >= m.x && m.z >= m.y) return r.z < 0.0 ? vec3(vec2(-r.x, -r.y) / m.z, 5.0) : vec3(vec2(r.x, -r.y) / m.z, 4.0);
    if (m.y >= m.x) return r.y < 0.0 ? vec3(vec2(r.x, -r.z) / m.y, 3.0) : vec3(vec2(r.x, r.z) / m.y, 2.0);
    return r.x < 0.0 ? vec3(vec2(r.z, -r.y) / m.x, 1.0) : vec3(vec2(-r.z, -r.y) / m.x, 0.0);
}
#endif
