#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Lists of a tile for what its depths leave: opaque pixels lie between the nearest and the farthest of them, translucent
// surfaces anywhere in front of the farthest.
#include "common/light_column.glsl"
#include "common/light_list_fill.glsl"

SPEC_CONSTANT(1, KINDS, PELLUCID_LIGHTS_OPAQUE | PELLUCID_LIGHTS_TRANSLUCENT);
PASS_TEXTURE(PELLUCID_LIGHTS_DEPTH) sampler2D opaque_depth;
shared uint nearest;   // bits of the greatest depth: depths are not negative, so bits are ordered as they are
shared uint farthest;  // of the least one that is not 0
shared uint open;      // pixels without anything opaque
Column column;
float near, far, farther;

uint reaches(vec4 sphere) {
    if (!in_column(column, sphere)) return 0u;
    uint opaque = nearest != 0u && in_slab(column, sphere, far, near) ? 1u : 0u;
    if (KINDS == PELLUCID_LIGHTS_OPAQUE) return opaque;
    uint translucent = in_slab(column, sphere, farther, 0.0) ? 1u : 0u;
    return KINDS == PELLUCID_LIGHTS_TRANSLUCENT ? translucent : opaque | translucent << 1u;
}

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        nearest = 0u;
        farthest = 0xFFFFFFFFu;
        open = 0u;
    }
    barrier();
    uvec2 size = uvec2(textureSize(opaque_depth, 0));
    uvec2 first = gl_WorkGroupID.xy * uint(PELLUCID_LIGHTS_TILE);
    uvec2 end = min(first + uint(PELLUCID_LIGHTS_TILE), size);
    for (uint i = gl_LocalInvocationID.x; i < uint(PELLUCID_LIGHTS_TILE * PELLUCID_LIGHTS_TILE);
         i += uint(PELLUCID_LIGHTS_THREADS)) {
        uvec2 at = first + uvec2(i % uint(PELLUCID_LIGHTS_TILE), i / uint(PELLUCID_LIGHTS_TILE));
        if (any(greaterThanEqual(at, end))) continue;
        float depth = texelFetch(opaque_depth, ivec2(at), 0).r;
        if (depth == 0.0) {
            atomicOr(open, 1u);
        } else {
            atomicMax(nearest, floatBitsToUint(depth));
            atomicMin(farthest, floatBitsToUint(depth));
        }
    }
    barrier();
    column = column_of_pixels(first, end);
    near = 0.0;
    far = 0.0;
    farther = -1e30;
    if (nearest != 0u) {
        near = view_from_depth(vec2(0.0), uintBitsToFloat(nearest)).z;
        far = view_from_depth(vec2(0.0), uintBitsToFloat(farthest)).z;
        if (open == 0u) farther = far;
    }
    uint tile = gl_WorkGroupID.y * frame.light_grid.x + gl_WorkGroupID.x;
    fill_lists(tile * frame.light_grid.y * frame.light_grid.z, frame.light_grid.y);
}
