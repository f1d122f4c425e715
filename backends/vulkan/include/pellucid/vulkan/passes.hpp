// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer and its passes for Vulkan, compiled once into the backend's library.  Include it beside (or instead of)
/// the passes' own headers to save their instantiation; without it everything works all the same.
#include <pellucid/vulkan/vulkan.hpp>
#include <pellucid/renderer/renderer.hpp>

#if !defined(PELLUCID_HEADER_ONLY)
namespace pellucid {
extern template class measure::GpuTimer<Vulkan>;
extern template class Graph<Vulkan>;
extern template class GBufferPass<Vulkan>;
extern template class LightingPass<Vulkan>;
extern template class SortedForwardPass<Vulkan>;
extern template class TonemapPass<Vulkan>;
extern template class GpuScene<Vulkan>;
extern template class Renderer<Vulkan>;
}  // namespace pellucid
#endif
