// SPDX-License-Identifier: MIT
#include <pellucid/core/version.hpp>

const char* pellucid::version() noexcept { return PELLUCID_VERSION; }
