// SPDX-License-Identifier: MIT
// What the A-buffer's resolve binds beside the lists of fragments.
#ifndef PELLUCID_GPU_ABUFFER_H
#define PELLUCID_GPU_ABUFFER_H
#include "pellucid/gpu/fragment_lists.h"

#define PELLUCID_ABUFFER_TARGET 0  // storage image, rgba16f: linear radiance, read and written
#define PELLUCID_ABUFFER_AUDIT 5   // storage image, r32ui: fragments composited in each pixel (audit only)
#endif
