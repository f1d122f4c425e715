// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The sessions of the backends that there are, compiled once into the viewer's library.
#include "session.hpp"
#include <pellucid/pellucid.hpp>

namespace pellucid::samples::viewer {
#if defined(PELLUCID_HAS_VULKAN)
extern template class Session<Vulkan>;
#endif
#if defined(PELLUCID_HAS_OPENGL)
extern template class Session<OpenGL>;
#endif
}  // namespace pellucid::samples::viewer
