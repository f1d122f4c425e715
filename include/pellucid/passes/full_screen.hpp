// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A fragment shader over the whole picture: what many passes end with.
#include <pellucid/gpu/bindings.h>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <pellucid/shaders/full_screen.hpp>
#include <initializer_list>
#include <utility>

namespace pellucid::inline v0_1 {

/// A sampler for texelFetch.
[[nodiscard]] constexpr rhi::SamplerDesc texel_sampler(const char* debug_name) {
    return {.min = rhi::Filter::nearest,
            .mag = rhi::Filter::nearest,
            .mipmapped = false,
            .wrap_u = rhi::Wrap::clamp,
            .wrap_v = rhi::Wrap::clamp,
            .debug_name = debug_name};
}

/// A texture bound to a number of the pass group.
struct BoundTexture {
    std::uint32_t binding = 0;
    rhi::Texture texture = {};
};

/// Shape of a pass group of sampled textures.
[[nodiscard]] inline rhi::GroupLayout sampled_layout(std::initializer_list<std::uint32_t> bindings) {
    rhi::GroupLayout layout;
    for (const std::uint32_t b : bindings) layout.bindings.push_back({b, rhi::BindingKind::sampled_texture});
    return layout;
}
/// A pass group of sampled textures.
[[nodiscard]] inline rhi::GroupDesc sampled_group(rhi::Sampler sampler, const SmallVector<BoundTexture, 8>& textures,
                                                  const char* debug_name) {
    rhi::GroupDesc group{.debug_name = debug_name};
    for (const BoundTexture& t : textures) {
        group.layout.bindings.push_back({t.binding, rhi::BindingKind::sampled_texture});
        group.bindings.push_back({.binding = t.binding, .texture = t.texture, .sampler = sampler});
    }
    return group;
}

/// A fragment shader over the picture, what it reads, and the state that it is drawn with.
struct FullScreenDesc {
    const rhi::Shader* fragment = nullptr;
    std::span<const rhi::SpecConstant> constants = {};
    SmallVector<BoundTexture, 8> textures = {};  ///< read with texelFetch
    SmallVector<rhi::ColorTarget, rhi::max_color_attachments> colors = {};
    rhi::DepthStencil depth = {};
    std::uint32_t push_bytes = 0;
    const char* debug_name = "full screen";
};

/// One triangle over the picture, with textures of its own.
template <rhi::Backend B>
class FullScreenPass {
public:
    /// Errors: those of creation.
    [[nodiscard]] static Result<FullScreenPass> create(typename B::Device& device, const FullScreenDesc& desc) {
        FullScreenPass pass;
        pass.textures_ = desc.textures;
        pass.name_ = desc.debug_name;
        PELLUCID_OWN(pass.sampler_, device, device.make_sampler(texel_sampler(desc.debug_name)));
        const rhi::GroupDesc group = sampled_group(pass.sampler_, desc.textures, desc.debug_name);
        PELLUCID_OWN(pass.group_, device, device.make_group(group));
        PELLUCID_OWN(pass.pipeline_, device,
                     device.make_pipeline(rhi::GraphicsPipelineDesc{.vertex = &shaders::full_screen_vert,
                                                                    .fragment = desc.fragment,
                                                                    .constants = desc.constants,
                                                                    .pass_group = group.layout,
                                                                    .push_bytes = desc.push_bytes,
                                                                    .colors = desc.colors,
                                                                    .depth = desc.depth,
                                                                    .cull = rhi::Cull::none,
                                                                    .debug_name = desc.debug_name}));
        return pass;
    }

    /// Records a render pass of `targets` (attachments and size) with one draw.  `inside(commands, draw)` may do more:
    /// it must call `draw()`, once or more.  Precondition: no pass is open.
    template <class Inside>
    void record(typename B::Commands& cmd, rhi::RenderPassDesc targets, Inside&& inside) const {
        for (const BoundTexture& t : textures_) targets.uses.push_back(rhi::use(t.texture, rhi::Access::sampled));
        targets.name = name_;
        cmd.begin_render(targets);
        cmd.bind_pipeline(pipeline_);
        cmd.bind_group(group_);
        inside(cmd, [&] { cmd.draw({.vertex_count = 3}); });
        cmd.end_render();
    }
    void record(typename B::Commands& cmd, const rhi::RenderPassDesc& targets) const {
        record(cmd, targets, [](typename B::Commands&, auto&& draw) { draw(); });
    }

private:
    SmallVector<BoundTexture, 8> textures_ = {};
    const char* name_ = "";
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
};

}  // namespace pellucid::inline v0_1
