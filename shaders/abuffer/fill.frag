#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of the A-buffer: every fragment is shaded and stored.
#include "common/shade_fragment.glsl"
#include "common/fragment_node.glsl"
#include "pellucid/gpu/abuffer.h"

layout(early_fragment_tests) in;
PASS_IMAGE(PELLUCID_ABUFFER_CURSORS, r32ui) uimage2D cursors;
PASS_IMAGE(PELLUCID_ABUFFER_NODES, rgba32ui) writeonly uimage2D nodes;

void main() {
    uvec4 node = pack_node(gl_FragCoord.z, fragment_order(), shade_fragment());
    uint place = imageAtomicAdd(cursors, ivec2(gl_FragCoord.xy), PELLUCID_LAYERS_GROUP);
    imageStore(nodes, node_texel(place), node);
}
