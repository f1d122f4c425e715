// SPDX-License-Identifier: MIT
#include <pellucid/scene/sample_scenes-inl.hpp>
