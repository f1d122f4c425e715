// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The texture that a window shows, or a file: two pictures side by side, and the user interface over them.
#include "layout.hpp"
#include "shaders/compose.h"
#include <pellucid/passes/full_screen.hpp>
#include <pellucid/rhi/readback.hpp>
#include <pellucid/shaders/viewer.hpp>

namespace pellucid::samples::viewer {

/// A picture of display-referred codes (usage sampled); each texel covers divisor² pixels.
struct Source {
    rhi::Texture texture = {};
    std::uint32_t divisor = 1;
};

template <rhi::Backend B>
class Canvas {
public:
    static constexpr rhi::Format format = rhi::Format::rgba8_unorm;

    /// Errors: those of creation.
    [[nodiscard]] static Result<Canvas> create(typename B::Device& device) {
        Canvas canvas;
        canvas.device_ = &device;
        PELLUCID_OWN(canvas.sampler_, device, device.make_sampler(texel_sampler("canvas")));
        PELLUCID_OWN(canvas.pipeline_, device,
                     device.make_pipeline(rhi::GraphicsPipelineDesc{.vertex = &shaders::full_screen_vert,
                                                                    .fragment = &shaders::viewer_compose_frag,
                                                                    .pass_group = group_layout(),
                                                                    .push_bytes = sizeof(gpu::ComposePush),
                                                                    .colors = {{.format = format}},
                                                                    .cull = rhi::Cull::none,
                                                                    .debug_name = "canvas"}));
        return canvas;
    }
    /// Both sides above 0.  Errors: those of creation; the canvas then keeps its size.
    [[nodiscard]] Result<void> resize(Extent2D size) {
        if (size == size_) return {};
        rhi::Unique<typename B::Device, rhi::Texture> made;
        PELLUCID_OWN(made, *device_,
                     device_->make_texture({.size = size,
                                            .format = format,
                                            .usage = rhi::TextureUsage::attachment | rhi::TextureUsage::copy_source,
                                            .debug_name = "canvas"}));
        texture_ = std::move(made);
        size_ = size;
        return {};
    }
    /// The pictures, where the layout has them; `right` is seen from column `split` on.  A null texture is not drawn.
    /// Precondition: no pass is open.  Errors: those of creation.
    [[nodiscard]] Result<void> record(typename B::Commands& cmd, const Layout& layout, Source left, Source right,
                                      std::uint32_t split) {
        constexpr float paper = 20 / 255.0f;
        rhi::RenderPassDesc pass{
            .colors = {{.texture = texture_, .clear = {paper, paper, paper, 1}}}, .size = size_, .name = "canvas"};
        if (!right.texture) right = left, split = layout.picture.width;
        if (!left.texture) left = right;
        if (left.texture) {
            PELLUCID_CHECK(bind(left.texture, right.texture));
            pass.uses.push_back(rhi::use(left.texture, rhi::Access::sampled));
            if (right.texture != left.texture) pass.uses.push_back(rhi::use(right.texture, rhi::Access::sampled));
        }
        cmd.begin_render(pass);
        if (left.texture) {
            cmd.bind_pipeline(pipeline_);
            cmd.bind_group(group_);
            cmd.push(rhi::bytes_of(gpu::ComposePush{.corner = {layout.picture.x, layout.picture.y},
                                                    .split = split,
                                                    .left_divisor = left.divisor,
                                                    .right_divisor = right.divisor}));
            cmd.set_scissor(layout.picture);
            cmd.draw({.vertex_count = 3});
        }
        cmd.end_render();
        return {};
    }

    [[nodiscard]] rhi::Texture texture() const noexcept { return texture_; }
    [[nodiscard]] Extent2D size() const noexcept { return size_; }
    /// `[h, w, 4]` codes; waits.
    [[nodiscard]] Result<Image8> read() const {
        return rhi::download_image<B, std::uint8_t>(*device_, texture_, size_, rhi::Format::rgba8_unorm);
    }

private:
    static rhi::GroupLayout group_layout() { return sampled_layout({PELLUCID_COMPOSE_LEFT, PELLUCID_COMPOSE_RIGHT}); }
    [[nodiscard]] Result<void> bind(rhi::Texture left, rhi::Texture right) {
        if (group_ && left == left_ && right == right_) return {};
        PELLUCID_OWN(group_, *device_,
                     device_->make_group(sampled_group(
                         sampler_, {{PELLUCID_COMPOSE_LEFT, left}, {PELLUCID_COMPOSE_RIGHT, right}}, "canvas")));
        left_ = left, right_ = right;
        return {};
    }

    typename B::Device* device_ = nullptr;
    rhi::Unique<typename B::Device, rhi::Texture> texture_;
    rhi::Unique<typename B::Device, rhi::Sampler> sampler_;
    rhi::Unique<typename B::Device, rhi::Pipeline> pipeline_;
    rhi::Unique<typename B::Device, rhi::Group> group_;
    rhi::Texture left_ = {}, right_ = {};  ///< of the group
    Extent2D size_ = {};
};

/// A picture that the CPU made, as a texture.
template <rhi::Backend B>
struct Uploaded {
    rhi::Unique<typename B::Device, rhi::Texture> texture;

    /// `[h, w, 4]` codes.  Errors: those of creation; the old picture stays then.
    [[nodiscard]] Result<void> set(typename B::Device& device, const Image8& picture) {
        PELLUCID_OWN(texture, device,
                     device.make_texture({.size = {picture.width, picture.height},
                                          .initial = rhi::bytes_of(std::span<const std::uint8_t>(picture.data)),
                                          .debug_name = "picture"}));
        return {};
    }
};

}  // namespace pellucid::samples::viewer
