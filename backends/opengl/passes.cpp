// SPDX-License-Identifier: MIT
#include <pellucid/opengl/passes.hpp>

namespace pellucid {
PELLUCID_RENDERER_INSTANCES(, OpenGL)
}  // namespace pellucid
