// SPDX-License-Identifier: MIT
#include <pellucid/vulkan/passes.hpp>

namespace pellucid {
template class measure::GpuTimer<Vulkan>;
template class Graph<Vulkan>;
template class GBufferPass<Vulkan>;
template class LightingPass<Vulkan>;
template class SortedForwardPass<Vulkan>;
template class TonemapPass<Vulkan>;
template class GpuScene<Vulkan>;
template class Renderer<Vulkan>;
}  // namespace pellucid
