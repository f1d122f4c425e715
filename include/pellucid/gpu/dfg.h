// SPDX-License-Identifier: MIT
// The directional albedo of the specular lobe as a table (reference/dfg_table.hpp): rows are roughness, columns
// x = √μ (1 + r)/(√μ + r), texel centres at 0 and 1; a texel holds loss, shift, and the averages of its row.
#ifndef PELLUCID_GPU_DFG_H
#define PELLUCID_GPU_DFG_H
#include "pellucid/gpu/types.h"

#define PELLUCID_DFG_TABLE 0              // storage image, rgba16f
#define PELLUCID_DFG_SIZE 128             // texels a side, threads that share a row
#define PELLUCID_DFG_MIN_ROUGHNESS 0.001  // stands for 0 in the first row
#endif
