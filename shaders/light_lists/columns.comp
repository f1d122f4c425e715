#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The list of a tile at any depth.
#include "common/light_column.glsl"
#include "common/light_list_fill.glsl"

Column column;

uint reaches(vec4 sphere) { return in_column(column, sphere) ? 1u : 0u; }

void main() {
    uvec2 first = gl_WorkGroupID.xy * uint(PELLUCID_LIGHTS_TILE);
    column = column_of_pixels(first, min(first + uint(PELLUCID_LIGHTS_TILE), uvec2(frame.pixel.zw)));
    fill_lists((gl_WorkGroupID.y * frame.light_grid.x + gl_WorkGroupID.x) * frame.light_grid.z, 1u);
}
