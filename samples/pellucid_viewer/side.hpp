// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// One of the two pictures: a renderer that follows what is asked for, and stays what it was where that cannot be.
#include "choices.hpp"
#include <pellucid/renderer/renderer.hpp>
#include <chrono>
#include <memory>
#include <string>

namespace pellucid::samples::viewer {

template <rhi::Backend B>
class Side {
public:
    /// Draws a frame of `scene` by these settings; where they (but for the exposure), or the scene, are new, with a new
    /// renderer, which takes the old one's place once it has drawn.  What cannot be done is `problem()`, and the last
    /// picture stays. Gives whether a frame was drawn.  Errors: device loss.
    [[nodiscard]] Result<bool> draw(typename B::Device& device, const std::shared_ptr<const Scene>& scene,
                                    const RenderSettings& wanted, const Camera& camera) {
        rebuilt_ = false;
        wanted_.exposure_ev = wanted.exposure_ev;
        if (renderer_) renderer_->set_exposure(wanted.exposure_ev);
        const bool tried = scene_ == scene && same(wanted_, wanted);
        if (!tried) {
            const bool other_scene = scene_ != scene;
            scene_ = scene;
            wanted_ = wanted;
            PELLUCID_TRY(const bool built, build(device, wanted, camera));
            if (built) return true;
            // The picture must at least be of the size and the scene that there are, by settings that worked.
            if (renderer_ && (other_scene || !(renderer_->settings().size == wanted.size))) {
                RenderSettings last = renderer_->settings();
                last.size = wanted.size;
                const Error why = error_;
                PELLUCID_TRY(const bool kept, build(device, last, camera));
                error_ = why;
                if (kept) return true;
            }
        }
        if (!renderer_) return false;
        const bool settled = tried && same(renderer_->settings(), wanted);
        return accept(renderer_->render(camera), settled);
    }
    void release() { *this = {}; }

    [[nodiscard]] Renderer<B>* renderer() const noexcept { return renderer_.get(); }
    /// One sentence: why the picture is not what was asked for; empty where it is.
    [[nodiscard]] const std::string& problem() const noexcept { return error_.message; }
    [[nodiscard]] const Error& error() const noexcept { return error_; }   ///< the same, where there is one
    [[nodiscard]] bool rebuilt() const noexcept { return rebuilt_; }       ///< by the last draw
    [[nodiscard]] rhi::Ticket ticket() const noexcept { return ticket_; }  ///< of the last picture
    [[nodiscard]] double build_ms() const noexcept { return build_ms_; }

private:
    [[nodiscard]] Result<bool> build(typename B::Device& device, const RenderSettings& settings, const Camera& camera) {
        const auto start = std::chrono::steady_clock::now();
        Result<std::unique_ptr<Renderer<B>>> made = Renderer<B>::create(device, *scene_, settings);
        build_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (!made) return refuse(made.error());
        const Result<rhi::Ticket> drawn = (*made)->render(camera);
        if (!drawn) return refuse(drawn.error());
        ticket_ = *drawn;
        renderer_ = std::move(*made);
        rebuilt_ = true;
        error_ = {};
        return true;
    }
    [[nodiscard]] Result<bool> accept(const Result<rhi::Ticket>& drawn, bool settled) {
        if (!drawn) return refuse(drawn.error());
        ticket_ = *drawn;
        if (settled) error_ = {};
        return true;
    }
    [[nodiscard]] Result<bool> refuse(const Error& error) {
        if (error.code == Errc::device_lost) return error;
        error_ = error;
        return false;
    }

    std::unique_ptr<Renderer<B>> renderer_;
    std::shared_ptr<const Scene> scene_;  ///< the last that was asked for
    RenderSettings wanted_;               ///< likewise
    Error error_;                         ///< without a message: none
    rhi::Ticket ticket_ = rhi::Ticket::none;
    bool rebuilt_ = false;
    double build_ms_ = 0;
};

}  // namespace pellucid::samples::viewer
