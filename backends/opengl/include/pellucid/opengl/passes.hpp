// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer and all passes for OpenGL, compiled once into the backend's library.  Include it beside (or instead of)
/// the passes' own headers to save their instantiation; without it they work all the same.
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/renderer/instances.hpp>

#if !defined(PELLUCID_HEADER_ONLY)
namespace pellucid::inline v0_1 {
PELLUCID_RENDERER_INSTANCES(extern, OpenGL)
}  // namespace pellucid::inline v0_1
#endif
