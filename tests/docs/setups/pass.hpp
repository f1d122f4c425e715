// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// In scope: an open device, a renderer, its camera, and a compute shader of the user's own.
#include <pellucid/pellucid.hpp>
#include <cstdio>

#define SETUP_PARAMETERS \
    typename B::Device &device, Renderer<B>&renderer, const Camera &camera, const rhi::Shader &shader
