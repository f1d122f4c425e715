// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// In scope: an open device, a scene, its camera, and a renderer of it.
#include <pellucid/pellucid.hpp>
#include <cstdio>

#define SETUP_PARAMETERS typename B::Device &device, Scene &scene, Camera &camera, Renderer<B>&renderer
