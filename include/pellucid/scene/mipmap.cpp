// SPDX-License-Identifier: MIT
#include <pellucid/scene/mipmap-inl.hpp>
