// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// In scope: a scene and its camera, nothing of a device.
#include <pellucid/pellucid.hpp>
#include <cstdio>

#define SETUP_PARAMETERS Scene &scene, Camera &camera
