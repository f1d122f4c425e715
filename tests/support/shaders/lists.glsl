// SPDX-License-Identifier: MIT
// Walks the lists of fragments and copies what it finds: two texels a fragment, nearest first, and for each pixel which
// class walked it and how often.
#define WINDOW 4
#define SORT(keys) SORT4(keys, 0)
#define BITONIC(keys) BITONIC4(keys, 0)
#include "common/fragment_lists.glsl"

PASS_IMAGE(0, rgba32ui) writeonly uimage2D found;
PASS_IMAGE(5, r32ui) uimage2D walks;  // (class + 1) << 8, and 1 a walk
SPEC_CONSTANT(2, DEEPEST, 1u);
#if defined(LISTS_SURFACES)
PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) readonly uimage2D looks;
#endif

ivec2 pixel;

bool visit(uint rank, uint place) {
    ivec2 at = ivec2(2u * (uint(pixel.x) * DEEPEST + rank), pixel.y);
    imageStore(found, at, imageLoad(nodes, node_texel(place)));
#if defined(LISTS_SURFACES)
    imageStore(found, at + ivec2(1, 0), imageLoad(looks, node_texel(place)));
#else
    imageStore(found, at + ivec2(1, 0), uvec4(0u));
#endif
    return rank + 1u < DEEPEST;
}

void main() {
    if (!find_pixel(pixel) || any(greaterThanEqual(pixel, imageSize(walks)))) return;
    imageStore(walks, pixel, uvec4((imageLoad(walks, pixel).r & 0xFFu) + 1u | (band.tile_class + 1u) << 8u));
    walk(pixel, fragment_count(pixel));
}
