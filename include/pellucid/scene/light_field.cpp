// SPDX-License-Identifier: MIT
#include <pellucid/scene/light_field-inl.hpp>
