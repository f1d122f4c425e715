#version 450
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: MIT
// The list of a slice of the view, whatever the pixel.  A thousandth more on both sides than `light_slice` gives it, for
// the rounding of logarithms.
#include "common/light_list_fill.glsl"

float nearer, farther;  // distances along the view

uint reaches(vec4 sphere) {
    return -sphere.z + sphere.w >= nearer && -sphere.z - sphere.w <= farther ? 1u : 0u;
}

void main() {
    float slice = float(gl_WorkGroupID.x);
    nearer = slice == 0.0 ? -1e30 : exp2((slice - frame.light_slices.y) / frame.light_slices.x) * 0.999;
    farther = slice == frame.light_slices.z
                  ? 1e30
                  : exp2((slice + 1.0 - frame.light_slices.y) / frame.light_slices.x) * 1.001;
    fill_lists(frame.light_ends.w + gl_WorkGroupID.x * frame.light_grid.z, 1u);
}
