// SPDX-License-Identifier: MIT
// Which lights reach which part of the view: lists of bits, one a light with a place, in the order of the lights.
//
// A list is words: first a bit for each word behind that is not 0, then a bit for each light.  Nothing overflows, and
// walking the bits upwards adds lights in the order in which a loop over all of them would.
//
// tiled: one or two lists a tile of the picture, for what lies between the nearest and the farthest opaque pixel of the
// tile, and for what is in front of the farthest (translucent surfaces).
// clustered: one list a tile, whatever the depth, and one a slice of the view; a cluster's list is both, bit by bit.
#ifndef PELLUCID_GPU_LIGHT_LISTS_H
#define PELLUCID_GPU_LIGHT_LISTS_H
#include "pellucid/gpu/types.h"

#define PELLUCID_LIGHTS_BOUNDS 12  // storage block: vec4 a light: centre (view space) and radius of what it reaches
#define PELLUCID_LIGHTS_DEPTH 13   // sampled: opaque depth (tiled)
#define PELLUCID_LIGHTS_LISTS 14   // storage block: uint: the lists of all tiles, row by row, then those of the slices

#define PELLUCID_LIGHTS_TILE 16    // edge of a tile [pixel]
#define PELLUCID_LIGHTS_SLICES 64  // of the view, by the logarithm of the distance
#define PELLUCID_LIGHTS_THREADS 64
// Lists that a tile keeps.
#define PELLUCID_LIGHTS_OPAQUE 1u
#define PELLUCID_LIGHTS_TRANSLUCENT 2u
#endif
