// SPDX-License-Identifier: MIT
// Every translucent fragment of a band of strips, those of a group of pixels next to each other, in no order, and lists
// of the tiles by how deep they are.
#ifndef PELLUCID_GPU_FRAGMENT_LISTS_H
#define PELLUCID_GPU_FRAGMENT_LISTS_H
#include "pellucid/gpu/layer_count.h"

// Pass group, beside PELLUCID_LAYERS_COUNTS.
#define PELLUCID_LISTS_CURSORS 2   // storage image, r32ui: where the pixel's next fragment goes
#define PELLUCID_LISTS_NODES 3     // storage image, rgba32ui: a texel a fragment, see common/fragment_node.glsl
#define PELLUCID_LISTS_LOOKS 4     // storage image, rgba32ui: the rest of a fragment that is not shaded yet
#define PELLUCID_LISTS_BASES 14    // storage block: uint a strip: where its fragments start
#define PELLUCID_LISTS_CLASSES 15  // storage block: ListClass a class; also the arguments of indirect dispatches
#define PELLUCID_LISTS_TILES 16    // storage block: tiles of each class, x | y << 16

#define PELLUCID_LISTS_TEXEL_BYTES 16
#define PELLUCID_LISTS_WIDTH_BITS 14  // fragment n is texel (n mod 2^14, n / 2^14)

// Tiles are sorted with as many registers as their deepest pixel needs: up to 4 layers, 8, 16, any number.
#define PELLUCID_LISTS_CLASS_COUNT 4
#define PELLUCID_LISTS_CLASS(layers) ((layers) <= 4u ? 0u : (layers) <= 8u ? 1u : (layers) <= 16u ? 2u : 3u)
#define PELLUCID_LISTS_COLUMNS 256u  // workgroups of a class lie in rows of so many: no dimension is too large

PELLUCID_GPU_BEGIN
/// The tiles of one class of depth, as the arguments of an indirect dispatch.
struct ListClass {
    uint columns;  // the arguments of its dispatch
    uint rows;
    uint depth;
    uint tiles;
};
PELLUCID_GPU_SIZE(ListClass, 16)

/// Push data of whoever makes or walks the lists.
struct ListBand {
    uint first_strip;
    uint tile_stride;         // places in a class's list
    float min_transmittance;  // below it a pixel is done
    uint tile_class;          // that is walked
};
PELLUCID_GPU_SIZE(ListBand, 16)
PELLUCID_GPU_END
#endif
