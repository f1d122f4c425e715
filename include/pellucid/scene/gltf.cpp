// SPDX-License-Identifier: MIT
#include <pellucid/scene/gltf-inl.hpp>
