#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Gives each pixel of a band its place in the lists, and each tile its class: one workgroup a strip.
#include "common/layer_groups.glsl"
#include "pellucid/gpu/fragment_lists.h"

layout(local_size_x = PELLUCID_LAYERS_THREADS) in;
PASS_IMAGE(PELLUCID_LISTS_CURSORS, r32ui) writeonly uimage2D cursors;
PASS_BUFFER_READ(PELLUCID_LISTS_BASES, BaseBuffer) { uint bases[]; };
PASS_BUFFER(PELLUCID_LISTS_CLASSES, ClassBuffer) { ListClass classes[]; };
PASS_BUFFER(PELLUCID_LISTS_TILES, TileBuffer) { uint tiles[]; };
PUSH_BLOCK(Push) { ListBand band; };
shared uint used;

void classify(uvec2 tile, uint deepest) {
    if (deepest == 0u) return;
    uint c = PELLUCID_LISTS_CLASS(deepest);
    uint index = atomicAdd(classes[c].tiles, 1u);
    atomicMax(classes[c].rows, index / PELLUCID_LISTS_COLUMNS + 1u);
    tiles[c * band.tile_stride + index] = tile.x | tile.y << 16u;
}

void main() {
    uint strip = band.first_strip + gl_WorkGroupID.x;
    if (gl_LocalInvocationID.x == 0u) used = bases[strip];
    barrier();
    uint columns = (uint(imageSize(counts).x) + PELLUCID_LAYERS_TILE - 1u) / PELLUCID_LAYERS_TILE;
    for (uint tile = gl_LocalInvocationID.x; tile < columns; tile += PELLUCID_LAYERS_THREADS) {
        uint deepest = 0u;
        for (uint row = 0u; row < PELLUCID_LAYERS_TILE; ++row) {
            uvec2 group = uvec2(tile, strip * PELLUCID_LAYERS_TILE + row);
            LayerStrip sum = sum_group(group);
            deepest = max(deepest, sum.deepest);
            uint first = atomicAdd(used, sum.slots);
            for (uint i = 0u; i < PELLUCID_LAYERS_GROUP; ++i)
                imageStore(cursors, ivec2(group.x * PELLUCID_LAYERS_GROUP + i, group.y), uvec4(first + i));
        }
        classify(uvec2(tile, strip), deepest);
    }
}
