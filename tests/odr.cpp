// SPDX-License-Identifier: MIT
// Part of every test program: a function or variable of a header that is not inline is defined twice and fails the
// link.
#include "support/assets.hpp"
#include "support/devices.hpp"
#if __has_include(<pellucid/pellucid.hpp>)
#include <pellucid/pellucid.hpp>
#endif
