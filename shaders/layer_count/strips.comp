#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sums the counts of each strip, and finds how deep each tile is: one workgroup a strip.
#include "common/layer_groups.glsl"

layout(local_size_x = PELLUCID_LAYERS_THREADS) in;
PASS_BUFFER(PELLUCID_LAYERS_STRIPS, StripBuffer) { LayerStrip strips[]; };
PASS_BUFFER(PELLUCID_LAYERS_TILES, TileBuffer) { uint tile_depths[]; };
shared uint fragments;
shared uint deepest;
shared uint covered;
shared uint slots;

void main() {
    if (gl_LocalInvocationID.x == 0u) {
        fragments = 0u;
        deepest = 0u;
        covered = 0u;
        slots = 0u;
    }
    barrier();
    uint tiles = (uint(imageSize(counts).x) + PELLUCID_LAYERS_TILE - 1u) / PELLUCID_LAYERS_TILE;
    for (uint tile = gl_LocalInvocationID.x; tile < tiles; tile += PELLUCID_LAYERS_THREADS) {
        uint tile_depth = 0u;
        for (uint row = 0u; row < PELLUCID_LAYERS_TILE; ++row) {
            LayerStrip group = sum_group(uvec2(tile, gl_WorkGroupID.x * PELLUCID_LAYERS_TILE + row));
            atomicAdd(fragments, group.fragments);
            tile_depth = max(tile_depth, group.deepest);
            atomicAdd(covered, group.covered);
            atomicAdd(slots, group.slots);
        }
        atomicMax(deepest, tile_depth);
        tile_depths[gl_WorkGroupID.x * tiles + tile] = tile_depth;
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) strips[gl_WorkGroupID.x] = LayerStrip(fragments, deepest, covered, slots);
}
