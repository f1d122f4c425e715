// SPDX-License-Identifier: MIT
// Where the two pictures are on the canvas.
#ifndef PELLUCID_VIEWER_COMPOSE_H
#define PELLUCID_VIEWER_COMPOSE_H
#include "pellucid/gpu/types.h"

#define PELLUCID_COMPOSE_LEFT 12   // sampled: display-referred
#define PELLUCID_COMPOSE_RIGHT 13  // likewise

PELLUCID_GPU_BEGIN
struct ComposePush {
    uvec2 corner;         // [pixel] of the picture on the canvas
    uint split;           // [pixel] first column of the picture that is right
    uint left_divisor;    // pixels a texel of the left picture
    uint right_divisor;   // and of the right one
    uint unused_0;
    uint unused_1;
    uint unused_2;
};
PELLUCID_GPU_SIZE(ComposePush, 32)
PELLUCID_GPU_OFFSET(ComposePush, split, 8)
PELLUCID_GPU_OFFSET(ComposePush, right_divisor, 16)
PELLUCID_GPU_END
#endif
