// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A session that outlives the loss of its device: it is made again on a new one.
#include "session.hpp"
#include <functional>

namespace pellucid::samples::viewer {

template <rhi::Backend B>
class Guarded {
public:
    using Clock = std::chrono::steady_clock;

    Guarded(rhi::DeviceDesc desc, State& state) : desc_(std::move(desc)), state_(state) {}

    /// Errors: those of Session::create.
    [[nodiscard]] Result<void> start() {
        PELLUCID_TRY(session_, Session<B>::create(desc_, state_));
        return {};
    }
    /// As Session::frame.  Where the device is lost, everything is made again on another and the frame drawn there; a
    /// second loss within a second is an error.
    [[nodiscard]] Result<bool> frame(const Input& input, Extent2D canvas) {
        Result<bool> drawn = session_->frame(input, canvas);
        while (!drawn && drawn.error().code == Errc::device_lost) {
            const Clock::time_point now = Clock::now();
            if (lost_ && now - *lost_ < std::chrono::seconds(1))
                return Error{Errc::device_lost, drawn.error().message + " (twice within a second: it is given up)"};
            lost_ = now;
            if (before_device_goes) before_device_goes();
            session_.reset();
            PELLUCID_CHECK(start());
            state_.say("the device was lost, and everything was made again: " + drawn.error().message, true);
            drawn = session_->frame({.seconds = input.seconds}, canvas);
        }
        return drawn;
    }
    [[nodiscard]] Session<B>& session() { return *session_; }

    std::function<void()> before_device_goes;  ///< what else lives on the device must go first

private:
    rhi::DeviceDesc desc_;
    State& state_;
    std::unique_ptr<Session<B>> session_;
    std::optional<Clock::time_point> lost_;
};

}  // namespace pellucid::samples::viewer
