// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The umbrella: the renderer, scenes and the RHI, and every backend that the program links.  Passes that a program
/// drives itself have headers of their own (passes/), or all at once `<backend>/passes.hpp`.
#include <pellucid/core/version.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/rhi/with_backend.hpp>
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/image_file.hpp>
#include <pellucid/scene/primitives.hpp>
#if defined(PELLUCID_HAS_VULKAN)
#include <pellucid/vulkan/renderer.hpp>
#endif
#if defined(PELLUCID_HAS_OPENGL)
#include <pellucid/opengl/renderer.hpp>
#endif

namespace pellucid::inline v0_1 {

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
/// The backends that this program links, best first.
using Backends = rhi::BackendList<Vulkan, OpenGL>;
#elif defined(PELLUCID_HAS_VULKAN)
using Backends = rhi::BackendList<Vulkan>;
#elif defined(PELLUCID_HAS_OPENGL)
using Backends = rhi::BackendList<OpenGL>;
#endif

}  // namespace pellucid::inline v0_1
