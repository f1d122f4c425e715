// SPDX-License-Identifier: MIT
// Fills lists of lights, one workgroup a tile or a slice.  The file that includes it defines `reaches`.
#ifndef PELLUCID_LIGHT_LIST_FILL_GLSL
#define PELLUCID_LIGHT_LIST_FILL_GLSL
#include "common/scene.glsl"
#include "pellucid/gpu/light_lists.h"

layout(local_size_x = PELLUCID_LIGHTS_THREADS) in;
PASS_BUFFER_READ(PELLUCID_LIGHTS_BOUNDS, BoundsBuffer) { vec4 bounds[]; };
PASS_BUFFER(PELLUCID_LIGHTS_LISTS, ListBuffer) { uint lists[]; };
shared uint found[2][PELLUCID_LIGHTS_THREADS];
shared uint summary[2][2];

// Bit i: the sphere may reach what list i is for.  Never too few.
uint reaches(vec4 sphere);

// Writes `count` (1 or 2) lists from word `first` on: 64 words of lights at a time, a word a thread.
void fill_lists(uint first, uint count) {
    uint light_count = frame.light_ends.z - frame.light_ends.x;
    uint stride = frame.light_grid.z, summaries = frame.light_grid.w;
    uint thread = gl_LocalInvocationID.x;
    for (uint block = 0u; block * 2048u < light_count; ++block) {
        for (uint list = 0u; list < 2u; ++list) {
            found[list][thread] = 0u;
            if (thread < 2u) summary[list][thread] = 0u;
        }
        barrier();
        for (uint i = 0u; i < 32u; ++i) {
            uint at = i * 64u + thread;
            uint light = block * 2048u + at;
            if (light >= light_count) break;
            uint hit = reaches(bounds[light]);
            if ((hit & 1u) != 0u) atomicOr(found[0][at / 32u], 1u << (at & 31u));
            if ((hit & 2u) != 0u) atomicOr(found[1][at / 32u], 1u << (at & 31u));
        }
        barrier();
        uint word = summaries + block * 64u + thread;
        for (uint list = 0u; list < count; ++list) {
            if (word < stride) lists[first + list * stride + word] = found[list][thread];
            if (found[list][thread] != 0u) atomicOr(summary[list][thread / 32u], 1u << (thread & 31u));
        }
        barrier();
        word = block * 2u + thread;
        for (uint list = 0u; list < count; ++list)
            if (thread < 2u && word < summaries) lists[first + list * stride + word] = summary[list][thread];
    }
}
#endif
