// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A scene of translucent surfaces, peeled: any of its layers, alone or composited.  PeelPass is driven here without
/// the renderer, so this is also an example of how passes are put together.
#include "choice.hpp"
#include <pellucid/graph/frame.hpp>
#include <pellucid/passes/peel.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/renderer/gpu_scene.hpp>
#include <pellucid/rhi/readback.hpp>
#include <memory>
#include <optional>

namespace pellucid::samples {

/// Everything that pictures of one size need.  The scene must have translucent surfaces only, and lights of its own.
/// `device` must outlive it.
template <rhi::Backend B>
class PeelingStage {
    using Device = typename B::Device;

public:
    /// Errors: `invalid_argument` where something of the scene is opaque; `unsupported` where the device cannot peel;
    /// those of creation.
    [[nodiscard]] static Result<std::unique_ptr<PeelingStage>> create(Device& device, const Scene& scene, Extent2D size,
                                                                      glm::vec3 background = {0, 0, 0}) {
        std::unique_ptr<PeelingStage> stage(new PeelingStage);
        stage->device_ = &device;
        stage->settings_ = {.size = size,
                            .transparency = Transparency::peel,
                            .lighting = LightAssignment::loop,  // no pass makes lists here
                            .background = background,
                            .default_light = false};
        PELLUCID_CHECK(check_device(Transparency::peel, device.info()));
        PELLUCID_CHECK(check_lights(scene.lights));
        const SceneNeeds needs = scene_needs(scene, stage->settings_);
        if (needs.opaque)
            return Error{Errc::invalid_argument, "the scene has opaque surfaces, and nothing here would draw them"};
        PELLUCID_TRY(stage->scene_, GpuScene<B>::create(device, scene, stage->settings_));
        PELLUCID_CHECK(stage->make_targets());
        PELLUCID_TRY(stage->peel_, PeelPass<B>::create(device,
                                                       {.fragments = {.size = size,
                                                                      .needs = needs.mask,
                                                                      .lights = needs.lights,
                                                                      .culls = stage->scene_->translucent_culls()}},
                                                       {.hdr = stage->hdr_,
                                                        .opaque = stage->depth_,
                                                        .next = stage->next_,
                                                        .layer = stage->layer_,
                                                        .sum = stage->sum_}));
        PELLUCID_TRY(stage->tonemap_,
                     TonemapPass<B>::create(device, stage->settings_.tonemap, stage->hdr_, stage->display_, size));
        return stage;
    }

    /// Draws these layers over the background, and waits now and then: whether there are more layers, the CPU decides.
    [[nodiscard]] Result<rhi::Ticket> draw(const Camera& camera, LayerRange range = {}) {
        SceneFrame frame(*device_, *scene_, camera, settings_);
        Result<void> done = frame.open();
        if (done) done = record(frame, range);
        if (done) return frame.close();
        frame.abandon();
        return done.error();
    }
    /// Of the deepest pixel, as far as the last picture had to look.
    [[nodiscard]] std::uint32_t layers() const { return peel_->layers(); }

    [[nodiscard]] rhi::Texture display() const { return display_; }
    [[nodiscard]] Extent2D size() const { return settings_.size; }
    /// `[h, w, 4]` display codes of the last picture; waits.
    [[nodiscard]] Result<Image8> read_display() {
        return rhi::download_image<B, std::uint8_t>(*device_, display_, settings_.size, rhi::Format::rgba8_unorm);
    }
    /// `[h, w, 4]` of the last picture before it met the background: premultiplied radiance, and the share of the light
    /// behind that gets through; waits.
    [[nodiscard]] Result<ImageF> read_layers() {
        return rhi::download_image<B, float>(*device_, sum_, settings_.size, rhi::Format::rgba32_float);
    }

private:
    /// Whenever a command list begins, the scene's data of the frame is uploaded.
    class SceneFrame final : public Frame<B> {
    public:
        SceneFrame(Device& device, GpuScene<B>& scene, const Camera& camera, const RenderSettings& settings)
            : Frame<B>(device), scene_(scene), camera_(camera), settings_(settings) {}

    private:
        Result<void> opened(typename B::Commands& cmd) override { return scene_.begin_frame(cmd, camera_, settings_); }
        GpuScene<B>& scene_;
        const Camera& camera_;
        const RenderSettings& settings_;
    };

    PeelingStage() = default;

    [[nodiscard]] Result<void> make_targets() {
        using enum rhi::TextureUsage;
        using enum rhi::Format;
        const auto make = [&](rhi::Format format, rhi::TextureUsage usage, const char* debug_name) {
            return device_->make_texture(
                {.size = settings_.size, .format = format, .usage = usage, .debug_name = debug_name});
        };
        PELLUCID_OWN(hdr_, *device_, make(rgba16_float, attachment | sampled, "hdr"));
        PELLUCID_OWN(display_, *device_, make(rgba8_unorm, storage | sampled | copy_source, "display"));
        PELLUCID_OWN(depth_, *device_, make(d32_float, attachment | sampled, "depth"));
        PELLUCID_OWN(next_, *device_, make(r32_float, attachment | sampled, "peel.next"));
        PELLUCID_OWN(layer_, *device_, make(d32_float, attachment, "peel.layer"));
        PELLUCID_OWN(sum_, *device_, make(rgba32_float, attachment | sampled | copy_source, "peel.sum"));
        return {};
    }

    [[nodiscard]] Result<void> record(Frame<B>& frame, LayerRange range) {
        const glm::vec3 b = settings_.background;
        frame.commands().begin_render({.colors = {{.texture = hdr_, .clear = {b.x, b.y, b.z, 1}}},
                                       .depth = {.texture = depth_},  // nothing opaque: infinitely far
                                       .size = settings_.size,
                                       .name = "background"});
        frame.commands().end_render();
        peel_->set_layers(range.first, range.end);
        peel_->begin();
        for (bool more = true; more;) {
            peel_->record_layers(frame.commands(), scene_->binding(), scene_->translucent(),
                                 scene_->translucent_reversed());
            PELLUCID_CHECK(frame.flush());
            PELLUCID_TRY(more, peel_->more(*device_));
        }
        peel_->composite(frame.commands());
        tonemap_->record(frame.commands(), scene_->binding().frame);
        return {};
    }

    Device* device_ = nullptr;
    RenderSettings settings_;
    std::optional<GpuScene<B>> scene_;
    rhi::Unique<Device, rhi::Texture> hdr_, display_, depth_, next_, layer_, sum_;
    std::optional<PeelPass<B>> peel_;
    std::optional<TonemapPass<B>> tonemap_;
};

}  // namespace pellucid::samples
