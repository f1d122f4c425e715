#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of the fragment lists: every fragment is shaded and stored.
#include "common/shade_fragment.glsl"
#include "common/fragment_node.glsl"

layout(early_fragment_tests) in;
PASS_IMAGE(PELLUCID_LISTS_CURSORS, r32ui) uimage2D cursors;
PASS_IMAGE(PELLUCID_LISTS_NODES, rgba32ui) writeonly uimage2D nodes;

void main() {
    uvec4 node = pack_color_node(gl_FragCoord.z, fragment_order(), shade_fragment());
    uint place = imageAtomicAdd(cursors, ivec2(gl_FragCoord.xy), PELLUCID_LAYERS_GROUP);
    imageStore(nodes, node_texel(place), node);
}
