// SPDX-License-Identifier: MIT
// Walks the fragments of a pixel front to back.  The entry file defines WINDOW and SORT(keys), then `visit`.
// Fragments are sorted in registers.  One window is enough for the tiles of a shallow class.  The entry of the deep class
// defines BITONIC(keys) too and takes any number of layers: the nearest WINDOW not visited yet are gathered block by block
// and visited, then the next, at O(n²/WINDOW) loads.
// With VISIT_IN_LOOP the body of `visit` is compiled once instead of WINDOW times: for those that light.
#include "common/prelude.glsl"
#include "common/fragment_node.glsl"
#include "common/sort_network.glsl"

layout(local_size_x = PELLUCID_LAYERS_TILE, local_size_y = PELLUCID_LAYERS_TILE) in;
SPEC_CONSTANT(3, FEW_TURNS, 0u);  // 1: two blocks a turn, because the driver limits turns: see `walk_turns`
PASS_IMAGE(PELLUCID_LAYERS_COUNTS, r32f) readonly image2D counts;
PASS_IMAGE(PELLUCID_LISTS_CURSORS, r32ui) readonly uimage2D cursors;
PASS_IMAGE(PELLUCID_LISTS_NODES, rgba32ui) readonly uimage2D nodes;
PASS_BUFFER_READ(PELLUCID_LISTS_CLASSES, ClassBuffer) { ListClass classes[]; };
PASS_BUFFER_READ(PELLUCID_LISTS_TILES, TileBuffer) { uint tiles[]; };
PUSH_BLOCK(Push) { ListBand band; };
#if defined(VISIT_IN_LOOP)
shared uint sorted[WINDOW][PELLUCID_LAYERS_TILE * PELLUCID_LAYERS_TILE];
#endif

// One fragment: 0 is the nearest.  False ends the walk.
bool visit(uint rank, uint place);

const Key NOTHING = Key(-1.0, 0, 0u);

Key load_key(uint first, uint i) {
    uint place = first + PELLUCID_LAYERS_GROUP * i;
    uvec2 key = imageLoad(nodes, node_texel(place)).xy;
    return Key(uintBitsToFloat(key.x), int(key.y), place);
}

// The pixel of this invocation; false where there is none.
bool find_pixel(out ivec2 at) {
    uint index = gl_WorkGroupID.y * PELLUCID_LISTS_COLUMNS + gl_WorkGroupID.x;
    if (index >= classes[band.tile_class].tiles) return false;
    uint tile = tiles[band.tile_class * band.tile_stride + index];
    at = ivec2(uvec2(tile & 0xFFFFu, tile >> 16u) * PELLUCID_LAYERS_TILE + gl_LocalInvocationID.xy);
    return true;
}
// Fragments of a pixel; beyond the picture an image reads as 0.
uint fragment_count(ivec2 at) { return uint(imageLoad(counts, at).r); }

#if defined(BITONIC)
// Into `keys`, sorted, goes what is nearest of them and of a block of fragments that are not visited yet.
void gather(inout Key keys[WINDOW], uint first, uint start, uint count, Key last) {
    Key block[WINDOW];
    for (int w = 0; w < WINDOW; ++w) {
        block[w] = NOTHING;
        if (start + uint(w) < count) block[w] = load_key(first, start + uint(w));
        if (!in_front(last, block[w])) block[w] = NOTHING;  // visited
    }
    SORT(block)
    // Of two sorted halves that meet at their far ends, the nearer of each pair.
    for (int w = 0; w < WINDOW; ++w)
        if (in_front(block[WINDOW - 1 - w], keys[w])) keys[w] = block[WINDOW - 1 - w];
    BITONIC(keys)
}
#endif

void walk(ivec2 at, uint count) {
    uint first = imageLoad(cursors, at).r - PELLUCID_LAYERS_GROUP * count;
    Key last = Key(2.0, 0, 0u);  // the farthest fragment visited
    uint rank = 0u;
    bool going = count > 0u;
    // Loops test at their end: a driver that masks instead of branching runs the body once more otherwise.
    do {
        Key keys[WINDOW];
#if defined(BITONIC)
        for (int w = 0; w < WINDOW; ++w) keys[w] = NOTHING;
        uint start = 0u;
        do {
            gather(keys, first, start, count, last);
            start += uint(WINDOW);
            if (FEW_TURNS != 0u) {
                gather(keys, first, start, count, last);
                start += uint(WINDOW);
            }
        } while (start < count);
#else
        for (int w = 0; w < WINDOW; ++w) {
            keys[w] = NOTHING;
            if (uint(w) < count) keys[w] = load_key(first, uint(w));
        }
        SORT(keys)
#endif
#if defined(VISIT_IN_LOOP)
        for (int w = 0; w < WINDOW; ++w) sorted[w][gl_LocalInvocationIndex] = keys[w].place;
        if (going) {
            uint w = 0u;
            uint end = min(count - rank, uint(WINDOW));
            do {
                going = visit(rank + w, sorted[w][gl_LocalInvocationIndex]);
            } while (++w < end && going);
        }
#else
        for (int w = 0; w < WINDOW; ++w)
            if (going && rank + uint(w) < count) going = visit(rank + uint(w), keys[w].place);
#endif
        last = keys[WINDOW - 1];
        rank += uint(WINDOW);
#if defined(BITONIC)
    } while (going && rank < count);
#else
    } while (false);
#endif
}
