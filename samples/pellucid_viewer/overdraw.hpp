// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Overdraw: how many fragments are rasterised at each pixel, opaque, masked and translucent ones, also those behind
/// what is opaque, and what a mask cuts out; back faces that the picture culls are culled.  It is what drawing the
/// scene in any order without a depth test would shade: a property of scene and camera, not of a method.
#include <pellucid/passes/draw_list.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/rhi/readback.hpp>
#include <pellucid/shaders/layer_count.hpp>
#include <algorithm>

namespace pellucid::samples::viewer {

/// Has its own copy of the scene on the device, for as long as the view is wanted.
template <rhi::Backend B>
class Overdraw {
public:
    /// Errors: `unsupported` on devices that cannot blend into 32-bit floats; those of creation.
    [[nodiscard]] static Result<Overdraw> create(typename B::Device& device, const Scene& scene, Extent2D size) {
        if (!device.info().float32_blending)
            return Error{Errc::unsupported, "overdraw is counted by blending into 32-bit floats, and " +
                                                device.info().name + " cannot: choose another view or another device"};
        Overdraw out;
        out.device_ = &device;
        out.settings_.size = size;
        PELLUCID_TRY(out.scene_, GpuScene<B>::create(device, scene, out.settings_));
        PELLUCID_OWN(out.counts_, device,
                     device.make_texture({.size = size,
                                          .format = rhi::Format::r32_float,
                                          .usage = rhi::TextureUsage::attachment | rhi::TextureUsage::copy_source,
                                          .debug_name = "overdraw"}));
        constexpr rhi::Blend add{
            .enabled = true, .dst_color = rhi::BlendFactor::one, .dst_alpha = rhi::BlendFactor::one};
        PELLUCID_CHECK(out.pipelines_.create(device,
                                             {.vertex = &shaders::scene_position_vert,
                                              .fragment = &shaders::layer_count_frag,
                                              .scene_group = scene_group_layout(),
                                              .colors = {{.format = rhi::Format::r32_float, .blend = add}},
                                              .debug_name = "overdraw"},
                                             out.scene_->opaque_culls() | out.scene_->translucent_culls()));
        return out;
    }
    [[nodiscard]] Extent2D size() const noexcept { return settings_.size; }

    /// `[h, w, 1]` fragments; draws them and waits.  Errors: device loss, memory.
    [[nodiscard]] Result<ImageF> count(const Camera& camera) {
        PELLUCID_TRY(typename B::Commands * cmd, device_->begin_frame());
        const Result<void> placed = scene_->begin_frame(*cmd, camera, settings_);
        if (placed) {
            const SceneBinding& binding = scene_->binding();
            rhi::RenderPassDesc pass{
                .colors = {{.texture = counts_}}, .uses = binding.uses, .size = settings_.size, .name = "overdraw"};
            pass.uses.push_back(rhi::use(binding.indices, rhi::Access::index_read));
            cmd->begin_render(pass);
            draw_items<B>(*cmd, pipelines_, binding, scene_->opaque());
            draw_items<B>(*cmd, pipelines_, binding, scene_->translucent());
            cmd->end_render();
        }
        PELLUCID_CHECK(device_->submit());  // the frame ends, whatever came before
        PELLUCID_CHECK(placed);
        return rhi::download_image<B, float>(*device_, counts_, settings_.size, rhi::Format::r32_float);
    }

private:
    typename B::Device* device_ = nullptr;
    RenderSettings settings_;
    std::optional<GpuScene<B>> scene_;
    CullVariants<B> pipelines_;
    rhi::Unique<typename B::Device, rhi::Texture> counts_;
};

}  // namespace pellucid::samples::viewer
