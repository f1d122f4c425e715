// SPDX-License-Identifier: MIT
#include <pellucid/opengl/passes.hpp>

namespace pellucid {
template class measure::GpuTimer<OpenGL>;
template class Graph<OpenGL>;
template class GBufferPass<OpenGL>;
template class LightingPass<OpenGL>;
template class SortedForwardPass<OpenGL>;
template class TonemapPass<OpenGL>;
template class GpuScene<OpenGL>;
template class Renderer<OpenGL>;
}  // namespace pellucid
