// SPDX-License-Identifier: MIT
#include <pellucid/scene/sort_conflicts-inl.hpp>
