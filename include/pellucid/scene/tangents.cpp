// SPDX-License-Identifier: MIT
#include <pellucid/scene/tangents-inl.hpp>
