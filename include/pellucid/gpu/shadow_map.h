// SPDX-License-Identifier: MIT
// Shadow maps: the layers of one d32_float array, depth reversed like everything else, and a record a map.
//
// A light has no map, one (a spot), up to four (a sun: cascades, the finest first) or six (a point light, or a spot too
// wide for one: the faces +x, -x, +y, -y, +z, -z of the world).  Record i is the first map of light i; the others of
// the same light follow each other from `rest` on.
#ifndef PELLUCID_GPU_SHADOW_MAP_H
#define PELLUCID_GPU_SHADOW_MAP_H
#include "pellucid/gpu/types.h"

#define PELLUCID_SHADOW_CASCADES 4  // of a directional light, at most
#define PELLUCID_SHADOW_FACES 6
#define PELLUCID_SHADOW_MIN_SIZE 16  // [texel] a side of a map

// Texels between what a map must show and its border: two that the filter reads beyond a point, and some for rounding.
#define PELLUCID_SHADOW_MARGIN 3
#define PELLUCID_SHADOW_FADE 16         // a cascade gives way to the next within this part of its side
#define PELLUCID_SHADOW_OFFSET 0.5      // [texel] that a receiver's plane is moved along its normal
#define PELLUCID_SHADOW_MAX_SLOPE 64.0  // of the receiver's plane against the map's: beyond 89.1° it is taken as that

PELLUCID_GPU_BEGIN
/// Scene group, PELLUCID_BIND_SHADOWS.  Map space is in metres: x right, y up, z against the way that light travels, as
/// a camera sees it; depth = (z clip.x + clip.y) / w, with w = z clip.z + clip.w.
struct ShadowRecord {
    vec3 axis_x;  // rows of map_from_view
    float offset_x;
    vec3 axis_y;
    float offset_y;
    vec3 axis_z;
    float offset_z;
    vec4 clip;        // zz, zw, wz, ww of ClipFromView
    float scale;      // texels from the map's middle = x scale / w
    float half_side;  // [texel]
    float error;      // [m] that single precision may put a point in a wrong place, and
    uint layer;
    uint count;    // maps of the light; 0: it casts no shadow
    uint rest;     // record of the second one
    float spread;  // what of it grows with w
    uint reserved;
};
PELLUCID_GPU_SIZE(ShadowRecord, 96)
PELLUCID_GPU_OFFSET(ShadowRecord, clip, 48)
PELLUCID_GPU_OFFSET(ShadowRecord, count, 80)
PELLUCID_GPU_END
#endif
