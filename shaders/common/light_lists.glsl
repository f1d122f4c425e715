// SPDX-License-Identifier: MIT
// Where the lights of a point are listed (gpu/light_lists.h).
#ifndef PELLUCID_LIGHT_LISTS_GLSL
#define PELLUCID_LIGHT_LISTS_GLSL
#include "common/scene.glsl"
#include "pellucid/gpu/light_lists.h"

uint light_slice(float ez) {
    float slice = log2(max(-ez, 1e-30)) * frame.light_slices.x + frame.light_slices.y;
    return uint(clamp(slice, 0.0, frame.light_slices.z));
}

// For `evaluate_lighting` in common/lighting.glsl, of the point `p` (view space) that is seen in a pixel: the first words of
// the lists whose common bits are its lights.  Without lists: the end of its lights in y.
uvec2 lights_at(ivec2 pixel, vec3 p, bool translucent) {
    if (needs(PELLUCID_NEED_LIGHT_TILES | PELLUCID_NEED_LIGHT_CLUSTERS)) {
        uvec2 at = uvec2(pixel) / uint(PELLUCID_LIGHTS_TILE);
        uint list = (at.y * frame.light_grid.x + at.x) * frame.light_grid.y;
        if (needs(PELLUCID_NEED_LIGHT_TILES)) {
            list += translucent ? frame.light_grid.y - 1u : 0u;
            return uvec2(list * frame.light_grid.z, 0u);
        }
        return uvec2(list * frame.light_grid.z, frame.light_ends.w + light_slice(p.z) * frame.light_grid.z);
    }
    bool rest_is_added = needs(PELLUCID_NEED_LIGHT_VOLUMES) && !translucent;
    return uvec2(0u, rest_is_added ? frame.light_ends.y : frame.light_ends.z);
}

// Word `i` of what `lights_at` gave.
uint light_word(uvec2 lists, uint i) {
    uint word = light_lists[lists.x + i];
    if (needs(PELLUCID_NEED_LIGHT_CLUSTERS)) word = word & light_lists[lists.y + i];
    return word;
}
#endif
