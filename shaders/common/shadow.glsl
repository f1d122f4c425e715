// SPDX-License-Identifier: MIT
// How much of a light gets to a point, by shadow maps (gpu/shadow_map.h).  In the form of reference/shadow_map.hpp.
//
// A box of 3×3 texels convolved with the bilinear kernel: 4×4 texels, weights (1-f, 1, 1, f)/3 along each axis, each
// compared by itself in single precision (the hardware's own filter of comparisons has 8 bits), against the depth of the
// receiver's plane at that texel (J. Isidoro, "Shadow mapping: GPU-based tips and techniques", GDC 2006), so that a
// plane does not shadow itself however it is turned.
#ifndef PELLUCID_SHADOW_GLSL
#define PELLUCID_SHADOW_GLSL
#include "common/scene.glsl"
#include "pellucid/gpu/shadow_map.h"

SCENE_TEXTURE(PELLUCID_BIND_SHADOW_MAPS) sampler2DArray shadow_maps;
SCENE_BUFFER_READ(PELLUCID_BIND_SHADOWS, ShadowBuffer) { ShadowRecord shadows[]; };

// A point as a map sees it.
struct MapPoint {
    vec2 at;         // [texel] from the top left
    vec2 corner;     // the second of the four columns and rows that the filter reads
    float depth;     // of the point, with the bias
    vec2 slope;      // change of depth from one texel to the next
    float inside;    // [texel] from what the filter reads to the border; 0 or less: it reads beyond
};

MapPoint map_point(ShadowRecord m, vec3 p, vec3 normal) {
    MapPoint o;
    o.inside = -1.0;
    EXACT vec3 q = vec3(dot3(m.axis_x, p), dot3(m.axis_y, p), dot3(m.axis_z, p));
    q = q + vec3(m.offset_x, m.offset_y, m.offset_z);
    EXACT vec3 n = vec3(dot3(m.axis_x, normal), dot3(m.axis_y, normal), dot3(m.axis_z, normal));
    EXACT float w = q.z * m.clip.z;
    w = w + m.clip.w;
    if (!(w > 0.0)) return o;
    bool parallel = m.clip.z == 0.0;
    // Slope of the surface in map space: how much z grows a metre along x and y.  A surface that is lit by its shading
    // normal alone, and turns its back to the light itself, is met as it comes.
    float facing = parallel ? n.z : -quotient(dot3(n, q), w);
    EXACT float over = facing > 1e-6 ? quotient(1.0, facing) : 0.0;
    EXACT vec2 slope = n.xy * -over;
    EXACT float slope2 = slope.x * slope.x;
    slope2 = slope2 + slope.y * slope.y;
    const float steepest = PELLUCID_SHADOW_MAX_SLOPE;
    if (slope2 > steepest * steepest) {
        EXACT float shorter = inversesqrt(slope2) * steepest;
        slope = slope * shorter;
        slope2 = steepest * steepest;
    }
    EXACT float texel = quotient(w, m.scale);
    EXACT float inverse = quotient(1.0, w);
    EXACT vec2 at = vec2(q.x, -q.y) * (m.scale * inverse);
    at = at + m.half_side;
    o.at = at;
    EXACT vec2 cell = at - 0.5;
    o.corner = floor(cell);
    EXACT float depth = q.z * m.clip.x;
    depth = depth + m.clip.y;
    depth = depth * inverse;
    EXACT float per_metre = m.clip.x - depth * m.clip.z;
    per_metre = per_metre * inverse;
    // Facets lie beside each other, not in one plane: the plane is moved along its normal, the point is not, nor the
    // shadow's edge.  Rasterisers move corners to a grid of 1/256 texel; a plane through neighbouring pixels is some 1e-4
    // off, and its slope by that times 1 + slope²; and single precision.
    EXACT float steep = abs(slope.x) + abs(slope.y);
    EXACT float bias = clamp(over, 1.0, steepest) * PELLUCID_SHADOW_OFFSET;
    bias = bias + steep * 0.0078125;
    bias = bias + slope2 * 0.0009765625;
    bias = bias * texel;
    EXACT float error = m.error + w * m.spread;
    bias = bias + (1.0 + steep) * error;
    EXACT float biased = depth + bias * per_metre;
    o.depth = biased + 2.384185791015625e-7;
    EXACT float step = texel * per_metre;
    EXACT vec2 change = vec2(slope.x, -slope.y) * step;
    o.slope = change;
    vec2 reach = vec2(m.half_side) - abs(at - m.half_side);
    o.inside = min(reach.x, reach.y) - 1.5;
    return o;
}

// 1 where the texel lets light through to the plane's depth at its middle.
float texel_light(ivec3 at, float depth) { return texelFetch(shadow_maps, at, 0).r <= max(depth, 0.0) ? 1.0 : 0.0; }

// Light through one row of four texels, times 3.
float row_light(ivec3 first, MapPoint o, float fraction, float row) {
    EXACT vec2 away = o.corner + vec2(-0.5, row + 0.5);
    away = away - o.at;
    EXACT float depth = o.depth + away.y * o.slope.y;
    depth = depth + away.x * o.slope.x;
    EXACT float d1 = depth + o.slope.x;
    EXACT float d2 = d1 + o.slope.x;
    EXACT float d3 = d2 + o.slope.x;
    EXACT float sum = texel_light(first, depth) * (1.0 - fraction);
    sum = sum + texel_light(first + ivec3(1, 0, 0), d1);
    sum = sum + texel_light(first + ivec3(2, 0, 0), d2);
    sum = sum + texel_light(first + ivec3(3, 0, 0), d3) * fraction;
    return sum;
}

float map_light(uint layer, MapPoint o) {
    EXACT vec2 fraction = o.at - 0.5;
    fraction = fraction - o.corner;
    ivec3 first = ivec3(ivec2(o.corner) - 1, int(layer));
    EXACT float sum = row_light(first, o, fraction.x, -1.0) * (1.0 - fraction.y);
    sum = sum + row_light(first + ivec3(0, 1, 0), o, fraction.x, 0.0);
    sum = sum + row_light(first + ivec3(0, 2, 0), o, fraction.x, 1.0);
    sum = sum + row_light(first + ivec3(0, 3, 0), o, fraction.x, 2.0) * fraction.y;
    // The weights of what is all lit add up to 9 but for rounding.
    return sum > 8.99999 ? 1.0 : sum * (1.0 / 9.0);
}

// The share, in [0,1], of light `i` that gets to the point `p` (view space) of a surface whose plane has this normal;
// `from_light`: p - the light's position, where it has one.  1 outside of what its maps show.
float shadow_light(uint i, vec3 p, vec3 normal, vec3 from_light) {
    uint count = shadows[i].count, rest = shadows[i].rest, at = i;
    if (count == 0u) return 1.0;
    if (count == uint(PELLUCID_SHADOW_FACES)) {
        EXACT vec3 d = frame.world_x.xyz * from_light.x;
        d = d + frame.world_y.xyz * from_light.y;
        d = d + frame.world_z.xyz * from_light.z;
        vec3 a = abs(d);
        uint face = a.x >= a.y && a.x >= a.z ? (d.x >= 0.0 ? 0u : 1u)
                    : a.y >= a.z             ? (d.y >= 0.0 ? 2u : 3u)
                                             : (d.z >= 0.0 ? 4u : 5u);
        at = face == 0u ? i : rest + face - 1u;
        count = 1u;
    }
    EXACT float sum = 0.0;
    EXACT float left = 1.0;
    for (uint k = 0u; k < count; ++k) {
        ShadowRecord m = shadows[k == 0u ? at : rest + k - 1u];
        MapPoint o = map_point(m, p, normal);
        if (!(o.inside > 0.0)) continue;
        // Towards its border a cascade gives way to the next one.
        EXACT float share = left;
        if (k + 1u < count) {
            EXACT float part = o.inside * quotient(float(PELLUCID_SHADOW_FADE), 2.0 * m.half_side);
            share = left * min(part, 1.0);
        }
        if (share > 0.0) sum = sum + map_light(m.layer, o) * share;
        left = left - share;
        if (left <= 0.0) break;
    }
    return sum + left;
}
#endif
