// SPDX-License-Identifier: MIT
#include <pellucid/reference/renderer-inl.hpp>
