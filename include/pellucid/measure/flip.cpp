// SPDX-License-Identifier: MIT
#include <pellucid/measure/flip-inl.hpp>
