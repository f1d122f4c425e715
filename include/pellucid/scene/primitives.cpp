// SPDX-License-Identifier: MIT
#include <pellucid/scene/primitives-inl.hpp>
