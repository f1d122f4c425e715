// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The viewer in a window, on one backend, until the window is closed or another backend is chosen.
#include "../support/window.hpp"
#include "start.hpp"
#include "window_input.hpp"
#include <pellucid/rhi/surface.hpp>
#include <optional>

namespace pellucid::samples::viewer {

/// Shows the canvas of a guarded session in a window.  Whatever happens to the device, the window stays.
template <rhi::PresentingBackend B>
class WindowLoop {
public:
    WindowLoop(const Options& options, State& state, Window& window, const rhi::DeviceDesc& desc)
        : options_(options), state_(state), window_(window), viewer_(desc, state), cache_(desc.pipeline_cache) {
        viewer_.before_device_goes = [this] { surface_.reset(); };
    }

    /// Gives the backend that was chosen instead, or nothing where the window was closed or all frames are drawn.
    /// Errors: those of Guarded, of the surface, and a scene of the command line that cannot be read.
    [[nodiscard]] Result<std::optional<std::string>> run(StartTimes& times) {
        bool announced = times.device > 0;  // another backend was first
        PELLUCID_TRY(bool drawn,
                     first_frame(viewer_, input_of(window_, 1.0 / 60), window_.framebuffer(), cache_, times));
        for (auto last = std::chrono::steady_clock::now();;) {
            if (drawn) PELLUCID_CHECK(present());
            if (!announced && !state_.loading.running()) {
                if (state_.facts.message_is_error && state_.loaded.scene->instances.empty())
                    return Error{Errc::io, state_.facts.message};
                times.load = state_.loaded.ms;
                if (frame_ms_ > 0) {  // the scene came after the first frame
                    times.renderer = viewer_.session().build_ms();
                    times.frame = frame_ms_ - times.renderer;
                }
                print(times, cache_);
                announced = true;
            }
            if (announced && options_.frames > 0 && ++frames_ >= options_.frames) return std::optional<std::string>();
            if (state_.requests.backend) return std::exchange(state_.requests.backend, std::nullopt);
            take_in(drawn);
            if (window_.closed()) return std::optional<std::string>();
            const auto now = std::chrono::steady_clock::now();
            const double seconds = std::chrono::duration<double>(now - std::exchange(last, now)).count();
            PELLUCID_TRY(drawn, viewer_.frame(input_of(window_, seconds), window_.framebuffer()));
            frame_ms_ = milliseconds_since(now);
        }
    }
    [[nodiscard]] Session<B>& session() { return viewer_.session(); }

private:
    /// A window that nobody looks at, or that has no pixels, waits for something to happen.
    void take_in(bool drawn) {
        if (!drawn)
            window_.wait(0.25);
        else if (!window_.focused() && options_.frames == 0)
            window_.wait(0.1);
        else
            window_.poll();
    }
    /// A device that is lost here is found lost by the next frame, which makes everything again.
    [[nodiscard]] Result<void> present() {
        if (!surface_) {
            auto made =
                B::Surface::create(viewer_.session().device(), {.window = window_.native(), .vsync = options_.vsync});
            if (!made) return made.error();
            surface_ = std::move(*made);
        }
        const Result<bool> shown = surface_->present(viewer_.session().canvas(), window_.framebuffer());
        if (!shown && shown.error().code != Errc::device_lost) return shown.error();
        return {};
    }

    const Options& options_;
    State& state_;
    Window& window_;
    Guarded<B> viewer_;
    std::unique_ptr<typename B::Surface> surface_;  // after the device's owner: it goes first
    std::string cache_;
    std::uint32_t frames_ = 0;
    double frame_ms_ = 0;  ///< [ms] that the last frame took, after the first
};

}  // namespace pellucid::samples::viewer
