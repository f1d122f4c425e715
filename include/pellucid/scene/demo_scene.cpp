// SPDX-License-Identifier: MIT
#include <pellucid/scene/demo_scene-inl.hpp>
