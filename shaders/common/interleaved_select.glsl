// SPDX-License-Identifier: MIT
// Chooses the surface that a pixel lights.  Of n layers a 2×2 quad lights each at least once: one in all four pixels, two as
// a checkerboard, three and four in columns and rows; every other pixel finds the layer that it does not light beside it,
// on both sides.
#include "common/fragment_lists.glsl"
#include "pellucid/gpu/interleaved.h"

PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) readonly uimage2D looks;
PASS_IMAGE(PELLUCID_INTERLEAVED_NODE, rgba32ui) writeonly uimage2D chosen_node;
PASS_IMAGE(PELLUCID_INTERLEAVED_LOOK, rgba32ui) writeonly uimage2D chosen_look;

uint wanted;
uint chosen;

bool visit(uint rank, uint place) {
    if (rank == wanted) chosen = place;
    return rank < wanted;
}

void main() {
    ivec2 at;
    if (!find_pixel(at)) return;
    uint count = fragment_count(at);
    uint column = uint(at.x & 1);
    uint row = uint(at.y & 1);
    wanted = count == 2u ? column ^ row : (column + 2u * row) % max(1u, min(count, 4u));
    chosen = 0u;
    walk(at, count);
    if (count == 0u) return;
    imageStore(chosen_node, at, imageLoad(nodes, node_texel(chosen)));
    imageStore(chosen_look, at, imageLoad(looks, node_texel(chosen)));
}
