// SPDX-License-Identifier: MIT
#include <pellucid/vulkan/passes.hpp>

namespace pellucid {
PELLUCID_RENDERER_INSTANCES(, Vulkan)
}  // namespace pellucid
