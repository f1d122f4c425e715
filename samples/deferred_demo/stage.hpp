// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the demonstration draws, whoever asks: a file sequence or a window.
#include "motion.hpp"
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/demo_scene.hpp>
#include <memory>

namespace pellucid::samples {

/// The demo scene under lights that move.  `device` must outlive it.
template <rhi::Backend B>
class DeferredStage {
public:
    [[nodiscard]] static Result<DeferredStage> create(typename B::Device& device, const RenderSettings& settings) {
        DeferredStage stage;
        stage.device_ = &device;
        stage.settings_ = settings;
        PELLUCID_CHECK(stage.build());
        return stage;
    }

    /// A picture of another size takes another renderer.  Errors: those of Renderer::create; the old one is then kept.
    [[nodiscard]] Result<void> resize(Extent2D size) {
        if (size == settings_.size) return {};
        const Extent2D before = std::exchange(settings_.size, size);
        const Result<void> built = build();
        if (!built) settings_.size = before;
        return built;
    }

    /// Records and submits a frame `seconds` after the start.
    [[nodiscard]] Result<rhi::Ticket> draw(const Camera& camera, double seconds) {
        orbit_lights(scene_.lights, seconds);
        PELLUCID_CHECK(renderer_->set_lights(scene_.lights));
        return renderer_->render(camera);
    }

    [[nodiscard]] Renderer<B>& renderer() { return *renderer_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }

private:
    [[nodiscard]] Result<void> build() {
        PELLUCID_TRY(renderer_, Renderer<B>::create(*device_, scene_, settings_));
        return {};
    }

    typename B::Device* device_ = nullptr;
    RenderSettings settings_;
    Scene scene_ = make_demo_scene();
    std::unique_ptr<Renderer<B>> renderer_;
};

}  // namespace pellucid::samples
