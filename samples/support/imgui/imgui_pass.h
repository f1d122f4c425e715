// SPDX-License-Identifier: MIT
// What the shaders of the user interface share with C++.  A vertex is ImDrawVert as it is: five words, position [point],
// texture coordinates, and a colour with red in the lowest byte.
#ifndef PELLUCID_IMGUI_PASS_H
#define PELLUCID_IMGUI_PASS_H
#include "pellucid/gpu/types.h"

#define PELLUCID_IMGUI_VERTICES 12  // storage block: words of vertices
#define PELLUCID_IMGUI_TEXTURE 13   // sampled: display-referred colour and alpha
#define PELLUCID_IMGUI_VERTEX_WORDS 5u

PELLUCID_GPU_BEGIN
struct ImguiPush {
    vec4 place;  // NDC = position · place.xy + place.zw
};
PELLUCID_GPU_SIZE(ImguiPush, 16)
PELLUCID_GPU_END
#endif
