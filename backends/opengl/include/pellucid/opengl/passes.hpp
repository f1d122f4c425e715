// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer and its passes for OpenGL, compiled once into the backend's library.  Include it beside (or instead of)
/// the passes' own headers to save their instantiation; without it everything works all the same.
#include <pellucid/opengl/opengl.hpp>
#include <pellucid/renderer/renderer.hpp>

#if !defined(PELLUCID_HEADER_ONLY)
namespace pellucid {
extern template class measure::GpuTimer<OpenGL>;
extern template class Graph<OpenGL>;
extern template class GBufferPass<OpenGL>;
extern template class LightingPass<OpenGL>;
extern template class SortedForwardPass<OpenGL>;
extern template class TonemapPass<OpenGL>;
extern template class GpuScene<OpenGL>;
extern template class Renderer<OpenGL>;
}  // namespace pellucid
#endif
