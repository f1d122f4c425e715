// SPDX-License-Identifier: MIT
#include <pellucid/measure/quality-inl.hpp>
