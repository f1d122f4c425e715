// SPDX-License-Identifier: MIT
#include <pellucid/vulkan/passes.hpp>

namespace pellucid::inline v0_1 {
PELLUCID_RENDERER_INSTANCES(, Vulkan)
}  // namespace pellucid::inline v0_1
