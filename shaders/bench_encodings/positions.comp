#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Points in view space through one encoding and back (benchmarks/encodings/positions.hpp has the same on the CPU).  The
// range of depth is that of the frame's projection.
#include "common/scene.glsl"
#include "common/gbuffer.glsl"
#include "bench_encodings/values.glsl"

SPEC_CONSTANT(1, FORM, ENCODING_NOTHING);
SPEC_CONSTANT(2, USE, POSITION_RELATIVE);
PASS_UNIFORMS(BENCH_ENCODINGS_MATRIX, Matrix) { EncodingMatrix world_from_clip; };

vec3 through_world(vec3 p) {
    vec3 world = world_from_view(p) + frame.camera_position;
    if (FORM != POSITION_WORLD_FLOAT) {
        uvec2 words = stored(uvec2(packHalf2x16(world.xy), packHalf2x16(vec2(world.z, 0.0))));
        world = vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x);
    }
    return view_from_world(world - frame.camera_position);
}
vec3 through_depth(vec3 p, vec2 fragcoord) {
    vec4 clip = clip_position(p);
    float depth = clip.z / clip.w;
    if (FORM == POSITION_DEPTH24) {
        uint code = uint(roundEven(clamp(depth, 0.0, 1.0) * 16777215.0));
        depth = float(stored(code)) * (1.0 / 16777215.0);
    }
    if (USE == POSITION_INVERSE_MATRIX) {
        vec2 ndc = vec2(fragcoord.x * frame.pixel.x - 1.0, 1.0 - fragcoord.y * frame.pixel.y);
        vec4 found = world_from_clip.x * ndc.x + world_from_clip.y * ndc.y + world_from_clip.z * depth;
        found += world_from_clip.w;
        return view_from_world(found.xyz * (1.0 / found.w) - frame.camera_position);
    }
    vec3 found = view_from_depth(fragcoord, depth);
    if (USE == POSITION_RELATIVE) return found;
    precise vec3 world = world_from_view(found) + frame.camera_position;
    return view_from_world(world - frame.camera_position);
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(errors)))) return;
    begin_values(at);
    float sum = 0.0, largest = 0.0;
    for (int i = 0; i < BENCH_ENCODINGS_VALUES; ++i) {
        float x = next_value(), y = next_value(), z = next_value();
        vec2 fragcoord = floor(vec2(x, y) * frame.pixel.zw) + 0.5;
        vec2 ndc = vec2(fragcoord.x * frame.pixel.x - 1.0, 1.0 - fragcoord.y * frame.pixel.y);
        float distance = BENCH_ENCODINGS_NEAR * exp2(z * BENCH_ENCODINGS_OCTAVES);
        vec3 p = vec3(ndc * distance * (1.0 / frame.clip_scale.xy), -distance);
        vec3 back = -p;
        if (FORM >= POSITION_DEPTH24) back = through_depth(p, fragcoord);
        else if (FORM != ENCODING_NOTHING) back = through_world(p);
        vec3 off = back - p;
        float square = dot(off, off) * (1.0 / dot(p, p));
        sum += square;
        largest = max(largest, square);
    }
    imageStore(errors, at, vec4(sum, largest, 0.0, 1.0));
}
