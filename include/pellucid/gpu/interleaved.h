// SPDX-License-Identifier: MIT
// What interleaved translucency binds beside the lists of fragments: one surface a pixel, and the light on it.
#ifndef PELLUCID_GPU_INTERLEAVED_H
#define PELLUCID_GPU_INTERLEAVED_H
#include "pellucid/gpu/fragment_lists.h"

#define PELLUCID_INTERLEAVED_NODE 6    // storage image, rgba32ui: the surface that a pixel lights, as in the lists
#define PELLUCID_INTERLEAVED_LOOK 7    // storage image, rgba32ui: the rest of it
#define PELLUCID_INTERLEAVED_NODES 18  // sampled: the same
#define PELLUCID_INTERLEAVED_LOOKS 19  // sampled: the same
#define PELLUCID_INTERLEAVED_LIGHT 20  // sampled, rgba16f: what light adds to it; of the lighting pass: image 1
#define PELLUCID_INTERLEAVED_OUTPUT 1
#endif
