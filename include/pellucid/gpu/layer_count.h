// SPDX-License-Identifier: MIT
// How many translucent fragments lie over each pixel, and what each strip of pixels adds up to.
#ifndef PELLUCID_GPU_LAYER_COUNT_H
#define PELLUCID_GPU_LAYER_COUNT_H
#include "pellucid/gpu/types.h"

#define PELLUCID_LAYERS_COUNTS 1   // storage image, r32f: fragments of each pixel
#define PELLUCID_LAYERS_STRIPS 13  // storage block: LayerStrip a strip
#define PELLUCID_LAYERS_TILES 14   // storage block: uint a tile: fragments of its deepest pixel; rows from the top

#define PELLUCID_LAYERS_TILE 8u  // edge of a tile, height of a strip [pixel]
// Neighbours in a row whose fragments are stored side by side, the first fragments of all, then the second ones, …:
// what a GPU works on at once lies in one place.
#define PELLUCID_LAYERS_GROUP 8u
#define PELLUCID_LAYERS_THREADS 64  // threads that share a strip; each takes whole tiles

PELLUCID_GPU_BEGIN
/// PELLUCID_LAYERS_TILE rows of pixels.
struct LayerStrip {
    uint fragments;  // of all its pixels
    uint deepest;    // of one pixel
    uint covered;    // pixels with any
    uint slots;      // places that its fragments take: groups are as deep as their deepest pixel
};
PELLUCID_GPU_SIZE(LayerStrip, 16)
PELLUCID_GPU_END
#endif
