// SPDX-License-Identifier: MIT
// The one registry of binding numbers.  A number is unique in the whole program, so it is the same on Vulkan (where the
// set comes with it) and on OpenGL (where sets do not exist).  Storage images take 0 … 7, because OpenGL guarantees
// only eight image units.
#ifndef PELLUCID_GPU_BINDINGS_H
#define PELLUCID_GPU_BINDINGS_H

// group 0, "frame": made and bound by the device
#define PELLUCID_BIND_FRAME 8    // uniform block: FrameParams, or what the user of the RHI uploads
#define PELLUCID_BIND_RECORDS 9  // storage block: per-draw records of this frame
#define PELLUCID_BIND_PUSH 10    // OpenGL only: the uniform block that stands for push constants

// group 1, "pass": images 0 … 7, the rest 12 … 23
#define PELLUCID_PASS_IMAGE_0 0
#define PELLUCID_PASS_0 12

// group 2, "scene": 24 … 47
#define PELLUCID_BIND_VERTICES 24
#define PELLUCID_BIND_INDICES 25
#define PELLUCID_BIND_MATERIALS 26
#define PELLUCID_BIND_DRAWS 27
#define PELLUCID_BIND_LIGHTS 28
#define PELLUCID_BIND_LIGHT_LISTS 29
#define PELLUCID_BIND_LIGHT_BLOCK 30  // uniform block: the first lights
#define PELLUCID_BIND_TEXTURES 32     // 32 … 39: texture arrays
#define PELLUCID_BIND_SHADOW_MAPS 40  // layers of depth (gpu/shadow_map.h)
#define PELLUCID_BIND_SHADOWS 41      // storage block: ShadowRecord a map
#define PELLUCID_BIND_DFG 44          // directional albedo (gpu/dfg.h)
#define PELLUCID_BIND_ENVIRONMENT 45  // cube: an environment's light, prefiltered (gpu/environment.h)
#define PELLUCID_BIND_SKY 46          // the sky's light (scene/sky.hpp)
#endif
