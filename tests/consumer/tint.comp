// SPDX-License-Identifier: MIT
// A shader outside the library: it finds the prelude and the shared structs.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "common/prelude.glsl"
#include "pellucid/gpu/scene.h"

layout(local_size_x = 64) in;
FRAME_BLOCK(FrameBlock) { FrameParams frame; };
PASS_BUFFER(12, Colors) { vec4 colors[]; };

void main() { colors[gl_GlobalInvocationID.x] *= frame.exposure; }
