// SPDX-License-Identifier: MIT
// The GPU scene's bindings and its position functions.  Every pass gets its clip-space position from here, so coverage
// and depth are equal bit for bit between passes and between APIs.
#ifndef PELLUCID_SCENE_GLSL
#define PELLUCID_SCENE_GLSL
#include "common/prelude.glsl"
#include "common/exact.glsl"
#include "pellucid/gpu/scene.h"

SPEC_CONSTANT(0, NEEDS, PELLUCID_NEED_ALL);
bool needs(uint bits) { return (NEEDS & bits) != 0u; }

FRAME_BLOCK(FrameBlock) { FrameParams frame; };
RECORD_BUFFER(RecordBuffer) { DrawRecord records[]; };
SCENE_BUFFER_READ(PELLUCID_BIND_VERTICES, VertexBuffer) { Vertex vertices[]; };
SCENE_BUFFER_READ(PELLUCID_BIND_INDICES, IndexBuffer) { uint indices[]; };
SCENE_BUFFER_READ(PELLUCID_BIND_MATERIALS, MaterialBuffer) { MaterialRecord materials[]; };
SCENE_BUFFER_READ(PELLUCID_BIND_LIGHTS, LightBuffer) { LightRecord lights[]; };
SCENE_UNIFORMS(PELLUCID_BIND_LIGHT_BLOCK, LightBlock) { LightRecord first_lights[PELLUCID_LIGHT_BLOCK]; };
SCENE_BUFFER_READ(PELLUCID_BIND_LIGHT_LISTS, LightListBuffer) { uint light_lists[]; };

// Object space → view space.
vec3 view_position(DrawRecord draw, vec3 p) {
    precise vec3 r = draw.axis_x * p.x;
    r = r + draw.axis_y * p.y;
    r = r + draw.axis_z * p.z;
    r = r + draw.origin;
    return r;
}

// View space → clip space, reversed depth.
vec4 clip_position(vec3 e) {
    precise float x = e.x * frame.clip_scale.x;
    x = x + frame.clip_scale.z;
    precise float y = e.y * frame.clip_scale.y;
    y = y + frame.clip_scale.w;
    precise float z = e.z * frame.clip_depth.x;
    z = z + frame.clip_depth.y;
    precise float w = e.z * frame.clip_depth.z;
    w = w + frame.clip_depth.w;
    return vec4(x, y, z, w);
}

// Pixel centre and stored depth → view space.  Reversed depth needs no cancelling difference, so the error is a few ulp
// at any distance.  Precondition: depth > 0.
vec3 view_from_depth(vec2 fragcoord, float depth) {
    precise float denominator = depth * frame.clip_depth.z;
    denominator = denominator - frame.clip_depth.x;
    precise float numerator = depth * frame.clip_depth.w;
    numerator = frame.clip_depth.y - numerator;
    precise float ez = numerator * (1.0 / denominator);
    precise float w = ez * frame.clip_depth.z;
    w = w + frame.clip_depth.w;
    precise float nx = fragcoord.x * frame.pixel.x;
    nx = nx - 1.0;
    precise float ny = fragcoord.y * frame.pixel.y;
    ny = 1.0 - ny;
    precise float ex = nx * w;
    ex = (ex - frame.clip_scale.z) * frame.view_scale.x;
    precise float ey = ny * w;
    ey = (ey - frame.clip_scale.w) * frame.view_scale.y;
    return vec3(ex, ey, ez);
}

// Unit direction from a point in view space to the eye: orthographic views are seen from infinitely far away.
vec3 direction_to_eye(vec3 p) {
    if (frame.clip_depth.z == 0.0) return vec3(0.0, 0.0, 1.0);
    return unit(-p);
}

LightRecord light_record(uint i) {
    if (needs(PELLUCID_NEED_LIGHT_BLOCK)) return first_lights[i];
    return lights[i];
}

vec4 unpack_color(uvec2 color) { return vec4(unpackUnorm2x16(color.x), unpackUnorm2x16(color.y)); }
#endif
