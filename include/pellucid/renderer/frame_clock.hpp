// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// GPU times of a frame's passes, where a frame may take several submissions.
#include <pellucid/measure/gpu_timer.hpp>
#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

namespace pellucid::inline v0_1 {

/// One scope at a time.  What a pass takes in all submissions of a frame is added up.
template <rhi::Backend B>
class FrameClock {
public:
    [[nodiscard]] static Result<FrameClock> create(typename B::Device& device) {
        FrameClock clock;
        PELLUCID_TRY(clock.timer_, measure::GpuTimer<B>::create(device));
        return clock;
    }

    void begin_frame() {
        earlier_.clear();
        name_ = nullptr;  // a frame that failed may have left its scope open
    }
    void open(typename B::Commands& cmd) {
        timer_->begin_frame(cmd);
        if (name_) index_ = timer_->begin(cmd, name_);
    }
    void begin_scope(typename B::Commands& cmd, const char* name) {
        name_ = name;
        index_ = timer_->begin(cmd, name);
    }
    void end_scope(typename B::Commands& cmd) {
        timer_->end(cmd, index_);
        name_ = nullptr;
    }
    /// Before a submission: a scope that is still open goes on in the next one.
    void closing(typename B::Commands& cmd) {
        if (name_) timer_->end(cmd, index_);
    }
    void closed(rhi::Ticket ticket) { timer_->end_frame(ticket); }
    /// After the wait between two submissions of a frame: keeps what the first took.
    [[nodiscard]] Result<void> waited() {
        // Frames before this one that nobody asked for come first.
        std::span<const measure::GpuSpan> spans;
        for (;;) {
            PELLUCID_TRY(const auto next, timer_->collect());
            if (next.empty()) break;
            newest_.assign(next.begin(), next.end());
        }
        add(newest_, earlier_);
        newest_.clear();
        return {};
    }

    /// GPU time of each pass of the newest frame whose timestamps have arrived; empty on devices without timestamps.
    [[nodiscard]] Result<std::span<const measure::GpuSpan>> collect() {
        PELLUCID_TRY(const auto last, timer_->collect());
        if (last.empty() || earlier_.empty()) return last;
        sums_ = earlier_;
        add(last, sums_);
        return std::span<const measure::GpuSpan>(sums_);
    }

private:
    static void add(std::span<const measure::GpuSpan> spans, std::vector<measure::GpuSpan>& sums) {
        for (const measure::GpuSpan& span : spans) {
            const auto same = [&](const measure::GpuSpan& s) { return std::strcmp(s.name, span.name) == 0; };
            const auto at = std::find_if(sums.begin(), sums.end(), same);
            if (at == sums.end())
                sums.push_back(span);
            else
                at->ms += span.ms;
        }
    }

    std::optional<measure::GpuTimer<B>> timer_;
    const char* name_ = nullptr;  ///< of the open scope
    std::uint32_t index_ = 0;
    std::vector<measure::GpuSpan> earlier_, newest_, sums_;
};

}  // namespace pellucid::inline v0_1
