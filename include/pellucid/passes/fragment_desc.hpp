// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What is the same for every method of transparency that sorts fragments: which there are, and how they are lit.
#include <pellucid/gpu/scene.h>
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/passes/lighting.hpp>
#include <array>

namespace pellucid::inline v0_1 {

/// What every method of transparency must know to draw and light fragments.
struct FragmentDesc {
    Extent2D size = {};  ///< [texel] of the picture
    Brdf brdf = Brdf::gltf;
    std::uint32_t needs = PELLUCID_NEED_ALL;  ///< PELLUCID_NEED_* of the scene
    std::uint32_t lights = 1;                 ///< of the scene
    std::uint32_t culls = 7;                  ///< bit (1 << Cull) for each way of culling in use
    bool exact = false;                       ///< the lighting arithmetic that gives the same bits on every API

    /// Of pipelines whose shaders call `shade_fragment`.
    [[nodiscard]] std::array<rhi::SpecConstant, 2> constants() const {
        return {{{0, needs}, {1, static_cast<std::uint32_t>(brdf)}}};
    }
    /// The depth test of translucent fragments against what is opaque, which they never write.
    [[nodiscard]] static constexpr rhi::DepthStencil depth_test() {
        return {.format = rhi::Format::d32_float, .test = true, .compare = rhi::Compare::greater_equal};
    }
    /// A pass that draws them: `depth` tested and not written, the scene's resources declared.
    [[nodiscard]] rhi::RenderPassDesc render_pass(rhi::Texture depth, const SceneBinding& scene,
                                                  const char* name) const {
        rhi::RenderPassDesc pass{.depth = {.texture = depth, .load = rhi::Load::load, .read_only = true},
                                 .uses = scene.uses,
                                 .size = size,
                                 .name = name};
        pass.uses.push_back(rhi::use(scene.indices, rhi::Access::index_read));
        return pass;
    }
};

}  // namespace pellucid::inline v0_1
