// SPDX-License-Identifier: MIT
// The sorted forward pass binds the scene (gpu/scene.h) and nothing else.
#ifndef PELLUCID_GPU_SORTED_FORWARD_H
#define PELLUCID_GPU_SORTED_FORWARD_H
#include "pellucid/gpu/scene.h"
#endif
