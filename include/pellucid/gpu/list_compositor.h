// SPDX-License-Identifier: MIT
// What composites the lists of fragments binds beside them.
#ifndef PELLUCID_GPU_LIST_COMPOSITOR_H
#define PELLUCID_GPU_LIST_COMPOSITOR_H
#include "pellucid/gpu/fragment_lists.h"

#define PELLUCID_COMPOSITOR_TARGET 0  // storage image, rgba16f: linear radiance, read and written
#define PELLUCID_COMPOSITOR_AUDIT 5   // storage image, r32ui: what the method tallies in each pixel (audit only)
#endif
