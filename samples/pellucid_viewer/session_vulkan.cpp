// SPDX-License-Identifier: MIT
#include "session.hpp"
#include <pellucid/pellucid.hpp>

namespace pellucid::samples::viewer {
template class Session<Vulkan>;
}  // namespace pellucid::samples::viewer
