// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer for Vulkan: declared here, compiled once into the backend's library.
#include <pellucid/vulkan/vulkan.hpp>
#include <pellucid/renderer/renderer.hpp>
#if defined(PELLUCID_HEADER_ONLY)
#include <pellucid/renderer/renderer-inl.hpp>
#else
namespace pellucid::inline v0_1 {
extern template class Renderer<Vulkan>;
}
#endif
