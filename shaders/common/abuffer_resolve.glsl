// SPDX-License-Identifier: MIT
// Composites a tile of the A-buffer front to back over what is opaque.  The entry file defines WINDOW, SORT(keys) and DEEP:
// fragments are sorted in registers and composited.  One window is enough for the tiles of a shallow class; the deep one
// takes any number of layers: the nearest WINDOW not composited yet, then the next, at O(n²/WINDOW) loads.
#include "common/prelude.glsl"
#include "common/fragment_node.glsl"
#include "common/sort_network.glsl"
#include "pellucid/gpu/abuffer.h"

layout(local_size_x = PELLUCID_LAYERS_TILE, local_size_y = PELLUCID_LAYERS_TILE) in;
SPEC_CONSTANT(2, AUDIT, 0u);
SPEC_CONSTANT(3, CLASS, 0u);
PASS_IMAGE(PELLUCID_LAYERS_COUNTS, r32f) readonly image2D counts;
PASS_IMAGE(PELLUCID_ABUFFER_CURSORS, r32ui) readonly uimage2D cursors;
PASS_IMAGE(PELLUCID_ABUFFER_NODES, rgba32ui) readonly uimage2D nodes;
PASS_IMAGE(PELLUCID_ABUFFER_AUDIT, r32ui) writeonly uimage2D composited;
PASS_IMAGE(PELLUCID_ABUFFER_TARGET, rgba16f) image2D hdr;
PASS_BUFFER_READ(PELLUCID_ABUFFER_CLASSES, ClassBuffer) { AbufferClass classes[]; };
PASS_BUFFER_READ(PELLUCID_ABUFFER_TILES, TileBuffer) { uint tiles[]; };
PUSH_BLOCK(Push) { AbufferResolve resolve; };

const Key NOTHING = Key(-1.0, 0, 0u);

Key load_key(uint first, uint i) {
    uint place = first + PELLUCID_LAYERS_GROUP * i;
    uvec2 key = imageLoad(nodes, node_texel(place)).xy;
    return Key(uintBitsToFloat(key.x), int(key.y), place);
}

void main() {
    uint index = gl_WorkGroupID.y * PELLUCID_ABUFFER_CLASS_COLUMNS + gl_WorkGroupID.x;
    if (index >= classes[CLASS].tiles) return;
    uint tile = tiles[CLASS * resolve.tile_stride + index];
    ivec2 at = ivec2(uvec2(tile & 0xFFFFu, tile >> 16u) * PELLUCID_LAYERS_TILE + gl_LocalInvocationID.xy);
    uint count = uint(imageLoad(counts, at).r);  // beyond the picture an image reads as 0
    uint first = imageLoad(cursors, at).r - PELLUCID_LAYERS_GROUP * count;

    precise vec3 color = vec3(0.0);
    precise float through = 1.0;
    Key last = Key(2.0, 0, 0u);  // the farthest fragment composited
    uint left = count;
    uint done = 0u;
    // Loops test at their end: a driver that masks instead of branching runs the body once more otherwise.
    do {
        Key keys[WINDOW];
        for (int w = 0; w < WINDOW; ++w) {
            keys[w] = NOTHING;
            if (uint(w) < count) keys[w] = load_key(first, uint(w));
            if (DEEP && !in_front(last, keys[w])) keys[w] = NOTHING;  // composited
        }
        SORT(keys)
        if (DEEP && count > WINDOW) {
            uint i = WINDOW;
            do {
                Key key = load_key(first, i);
                if (!in_front(last, key)) key = NOTHING;
                for (int w = 0; w < WINDOW; ++w) compare_swap(keys[w], key);
            } while (++i < count);
        }
        for (int w = 0; w < WINDOW; ++w) {
            if (uint(w) < left && through > resolve.min_transmittance) {
                vec4 c = unpack_node_color(imageLoad(nodes, node_texel(keys[w].place)).zw);
                color = color + c.rgb * through;
                through = through * (1.0 - c.a);
                ++done;
            }
        }
        last = keys[WINDOW - 1];
        left -= min(left, uint(WINDOW));
    } while (DEEP && left > 0u && through > resolve.min_transmittance);
    if (count == 0u) return;
    if (AUDIT != 0u) imageStore(composited, at, uvec4(done));
    vec4 behind = imageLoad(hdr, at);
    color = color + behind.rgb * through;
    imageStore(hdr, at, vec4(min(color, vec3(65504.0)), behind.a));
}
