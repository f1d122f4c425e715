// SPDX-License-Identifier: MIT
#include <pellucid/scene/teapot-inl.hpp>
