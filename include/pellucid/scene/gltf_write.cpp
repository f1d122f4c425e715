// SPDX-License-Identifier: MIT
#include <pellucid/scene/gltf_write-inl.hpp>
