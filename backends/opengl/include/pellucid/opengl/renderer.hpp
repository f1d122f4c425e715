// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer for OpenGL: declared here, compiled once into the backend's library.
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/renderer/renderer.hpp>
#if defined(PELLUCID_HEADER_ONLY)
#include <pellucid/renderer/renderer-inl.hpp>
#else
namespace pellucid::inline v0_1 {
extern template class Renderer<OpenGL>;
}
#endif
