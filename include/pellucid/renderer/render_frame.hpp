// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A frame of the renderer: whenever a command list begins, the scene's data of the frame is uploaded into its ring.
#include <pellucid/graph/frame.hpp>
#include <pellucid/renderer/frame_clock.hpp>
#include <pellucid/renderer/gpu_scene.hpp>

namespace pellucid::inline v0_1 {

/// Lives as long as the recording of one frame.
template <rhi::Backend B>
class RenderFrame final : public Frame<B> {
public:
    RenderFrame(typename B::Device& device, GpuScene<B>& scene, FrameClock<B>& clock, const Camera& camera,
                const RenderSettings& settings)
        : Frame<B>(device), scene_(scene), clock_(clock), camera_(camera), settings_(settings) {
        clock_.begin_frame();
    }
    void begin_scope(const char* name) { clock_.begin_scope(this->commands(), name); }
    void end_scope() {
        if (this->is_open()) clock_.end_scope(this->commands());
    }

private:
    Result<void> opened(typename B::Commands& cmd) override {
        clock_.open(cmd);
        return scene_.begin_frame(cmd, camera_, settings_);
    }
    void closing(typename B::Commands& cmd) override { clock_.closing(cmd); }
    void closed(rhi::Ticket ticket) override { clock_.closed(ticket); }
    Result<void> waited() override { return clock_.waited(); }

    GpuScene<B>& scene_;
    FrameClock<B>& clock_;
    const Camera& camera_;
    const RenderSettings& settings_;
};

}  // namespace pellucid::inline v0_1
