// SPDX-License-Identifier: MIT
#include <pellucid/measure/ssim-inl.hpp>
