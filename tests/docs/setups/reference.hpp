// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// In scope: a scene, its camera, and a picture `[h, w, 3]` of it; the reference renderer and the measures.
#include <pellucid/measure/flip.hpp>
#include <pellucid/measure/image_error.hpp>
#include <pellucid/pellucid.hpp>
#include <pellucid/reference/renderer.hpp>
#include <cstdio>

#define SETUP_PARAMETERS const Scene &scene, const Camera &camera, const ImageF &test
