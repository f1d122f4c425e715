// SPDX-License-Identifier: MIT
// What scene_vertex.glsl hands to a fragment shader, as load_surface wants it.
#ifndef PELLUCID_GEOMETRY_IN_GLSL
#define PELLUCID_GEOMETRY_IN_GLSL
#include "common/surface.glsl"

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;
layout(location = 4) flat in uvec3 in_draw;  // material, PELLUCID_DRAW_* flags, global id of the draw's triangle 0

Attributes fragment_attributes() {
    Attributes a;
    a.normal = in_normal;
    a.tangent = in_tangent;
    a.uv = in_uv;
    a.uv_dx = dFdxFine(in_uv);
    a.uv_dy = dFdyFine(in_uv);
    a.color = (in_draw.y & PELLUCID_DRAW_COLORS) != 0u ? in_color : vec4(1.0);
    a.front = gl_FrontFacing != ((in_draw.y & PELLUCID_DRAW_MIRRORED) != 0u);
    return a;
}
#endif
