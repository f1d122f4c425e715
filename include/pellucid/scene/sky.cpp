// SPDX-License-Identifier: MIT
#include <pellucid/scene/sky-inl.hpp>
