// SPDX-License-Identifier: MIT
#include <pellucid/opengl/passes.hpp>

namespace pellucid::inline v0_1 {
PELLUCID_RENDERER_INSTANCES(, OpenGL)
}  // namespace pellucid::inline v0_1
