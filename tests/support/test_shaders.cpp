// SPDX-License-Identifier: MIT
// The small shaders of the tests: pellucid_add_shader() puts them into this library.
#include <pellucid/shaders/test.hpp>
