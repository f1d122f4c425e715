#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// Sink of the fragment lists: the surface of every fragment is stored, to be lit later.  Always the exact arithmetic, as in
// the G-buffer: one bit here is one code of the stored normal.
#define PELLUCID_EXACT 1
#include "common/geometry_in.glsl"
#include "common/surface_node.glsl"

layout(early_fragment_tests) in;
PASS_IMAGE(PELLUCID_LISTS_CURSORS, r32ui) uimage2D cursors;
PASS_IMAGE(PELLUCID_LISTS_NODES, rgba32ui) writeonly uimage2D nodes;
PASS_IMAGE(PELLUCID_LISTS_LOOKS, rgba32ui) writeonly uimage2D looks;

void main() {
    Surface s = fragment_surface();
    uint place = imageAtomicAdd(cursors, ivec2(gl_FragCoord.xy), PELLUCID_LAYERS_GROUP);
    imageStore(nodes, node_texel(place), pack_surface_node(s, gl_FragCoord.z, fragment_order()));
    imageStore(looks, node_texel(place), pack_surface_look(s, in_draw.w & 0xFFFFu));
}
