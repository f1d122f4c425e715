// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// GPU times of named scopes, from timestamp queries, without stalls and without allocations in a frame.
///
/// A frame:  `timer.begin_frame(commands)` → scopes → `device.submit()` → `timer.end_frame(ticket)`.  Some frames later
/// `timer.collect()` returns its spans.  A ring of `frames_in_flight + 1` query pools keeps results readable while the
/// next frames are recorded; a frame that nobody collected before its pool comes round again is dropped and counted.
///
/// A timestamp is written when the GPU has finished what was recorded before it, so a scope's time is that of its work
/// where scopes follow each other, and an upper bound where the GPU overlaps them.  On software implementations the
/// timestamps need not bracket the work: measure the wall clock around submit-and-wait there.
#include <cstdint>
#include <pellucid/core/result.hpp>
#include <pellucid/rhi/backend.hpp>
#include <pellucid/rhi/unique.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pellucid::inline v0_1::measure {

/// How much a timer can hold.
struct GpuTimerDesc {
    std::uint32_t frames_in_flight = 2;  ///< as in `rhi::DeviceDesc`
    std::uint32_t max_scopes = 64;       ///< in one frame; > 0
    const char* debug_name = "gpu timer";
};

/// The time of one scope.
struct GpuSpan {
    const char* name = "";
    double ms = 0;
};

/// The device must outlive the timer.  Not thread-safe.  Where the device has no timestamps (`timestamp_ns == 0`)
/// nothing is created, every call does nothing, and `collect` returns no spans.
template <rhi::Backend B>
class GpuTimer {
public:
    /// Ends its scope when it goes.  It must not outlive the recording of its frame.
    class [[nodiscard]] Scope {
    public:
        Scope(GpuTimer& timer, rhi::CommandsFor<B>& commands, const char* name)
            : timer_(timer), commands_(commands), index_(timer.begin(commands, name)) {}
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope() { timer_.end(commands_, index_); }

    private:
        GpuTimer& timer_;
        rhi::CommandsFor<B>& commands_;
        std::uint32_t index_;
    };

    /// Errors: invalid_argument for `max_scopes` 0; what `make_queries` reports.
    [[nodiscard]] static Result<GpuTimer> create(rhi::DeviceFor<B>& device, const GpuTimerDesc& desc = {});

    /// Outside passes, before the frame's first scope.
    void begin_frame(rhi::CommandsFor<B>& commands);
    /// After `submit`, with its ticket.
    void end_frame(rhi::Ticket ticket);

    /// Starts a scope.  `name` is kept by pointer until the span has been collected: a literal, or a pass's own name.
    /// Scopes may nest.  Beyond `max_scopes` a scope is not measured, and counted in `dropped_scopes`.
    std::uint32_t begin(rhi::CommandsFor<B>& commands, const char* name);
    /// Ends the scope that `begin` returned `index` for.  Every scope must be ended before `end_frame`.
    void end(rhi::CommandsFor<B>& commands, std::uint32_t index);
    Scope scope(rhi::CommandsFor<B>& commands, const char* name) { return Scope(*this, commands, name); }

    /// The spans of the oldest finished frame not returned yet, in the order of `begin`; empty where there is none yet.
    /// Never waits.  The span is valid until the next call of `collect`.
    [[nodiscard]] Result<std::span<const GpuSpan>> collect();

    [[nodiscard]] bool available() const noexcept { return tick_ns_ > 0; }
    [[nodiscard]] std::uint64_t dropped_frames() const noexcept { return dropped_frames_; }
    [[nodiscard]] std::uint64_t dropped_scopes() const noexcept { return dropped_scopes_; }

private:
    static constexpr std::uint32_t not_measured = ~0u;

    struct Frame {
        rhi::Unique<rhi::DeviceFor<B>, rhi::Queries> queries;
        std::vector<const char*> names;  ///< capacity max_scopes; scope i has timestamps 2i and 2i+1
        rhi::Ticket ticket = rhi::Ticket::none;
        bool pending = false;  ///< submitted and not collected
    };

    GpuTimer() = default;

    rhi::DeviceFor<B>* device_ = nullptr;
    double tick_ns_ = 0;
    std::uint32_t max_scopes_ = 0;
    std::vector<Frame> frames_;
    std::size_t recording_ = 0;  ///< the frame that scopes go to
    bool open_ = false;          ///< between begin_frame and end_frame
    std::vector<std::uint64_t> ticks_;
    std::vector<GpuSpan> spans_;
    std::uint64_t dropped_frames_ = 0, dropped_scopes_ = 0;
};

// ---------------------------------------------------------------------------------------------------- bodies

template <rhi::Backend B>
Result<GpuTimer<B>> GpuTimer<B>::create(rhi::DeviceFor<B>& device, const GpuTimerDesc& desc) {
    if (desc.max_scopes == 0)
        return Error{Errc::invalid_argument,
                     std::string(desc.debug_name) + ": max_scopes is 0, but a GPU timer needs at least 1"};
    GpuTimer timer;
    timer.device_ = &device;
    timer.tick_ns_ = std::as_const(device).info().timestamp_ns;
    if (!timer.available()) return timer;
    timer.max_scopes_ = desc.max_scopes;
    timer.ticks_.resize(std::size_t{2} * desc.max_scopes);
    timer.spans_.reserve(desc.max_scopes);
    timer.frames_.resize(std::size_t{desc.frames_in_flight} + 1);
    for (Frame& frame : timer.frames_) {
        frame.names.reserve(desc.max_scopes);
        PELLUCID_OWN(
            frame.queries, device,
            device.make_queries(
                {.kind = rhi::QueryKind::timestamp, .count = 2 * desc.max_scopes, .debug_name = desc.debug_name}));
    }
    return timer;
}

template <rhi::Backend B>
void GpuTimer<B>::begin_frame(rhi::CommandsFor<B>& commands) {
    if (!available()) return;
    recording_ = (recording_ + 1) % frames_.size();
    Frame& frame = frames_[recording_];
    dropped_frames_ += frame.pending;
    frame.pending = false;
    frame.names.clear();
    commands.reset(frame.queries);
    open_ = true;
}

template <rhi::Backend B>
void GpuTimer<B>::end_frame(rhi::Ticket ticket) {
    if (!open_) return;
    open_ = false;
    Frame& frame = frames_[recording_];
    frame.ticket = ticket;
    frame.pending = !frame.names.empty();
}

template <rhi::Backend B>
std::uint32_t GpuTimer<B>::begin(rhi::CommandsFor<B>& commands, const char* name) {
    if (!open_) return not_measured;
    Frame& frame = frames_[recording_];
    if (frame.names.size() == max_scopes_) {
        ++dropped_scopes_;
        return not_measured;
    }
    const auto index = static_cast<std::uint32_t>(frame.names.size());
    frame.names.push_back(name);
    commands.write_timestamp(frame.queries, 2 * index);
    return index;
}

template <rhi::Backend B>
void GpuTimer<B>::end(rhi::CommandsFor<B>& commands, std::uint32_t index) {
    if (index != not_measured && open_) commands.write_timestamp(frames_[recording_].queries, 2 * index + 1);
}

template <rhi::Backend B>
Result<std::span<const GpuSpan>> GpuTimer<B>::collect() {
    spans_.clear();
    for (std::size_t i = 1; i <= frames_.size(); ++i) {  // oldest first
        Frame& frame = frames_[(recording_ + i) % frames_.size()];
        if (!frame.pending) continue;
        if (!device_->done(frame.ticket)) break;  // later frames are not done either
        frame.pending = false;
        const std::span<std::uint64_t> ticks(ticks_.data(), 2 * frame.names.size());
        PELLUCID_CHECK(device_->results(frame.queries, 0, ticks));
        for (std::size_t s = 0; s < frame.names.size(); ++s) {
            // A counter that wrapped, or a driver without order, gives an end before its beginning: no time is known.
            if (ticks[2 * s + 1] < ticks[2 * s]) {
                ++dropped_scopes_;
                continue;
            }
            spans_.push_back({frame.names[s], static_cast<double>(ticks[2 * s + 1] - ticks[2 * s]) * tick_ns_ * 1e-6});
        }
        break;
    }
    return std::span<const GpuSpan>(spans_);
}

}  // namespace pellucid::inline v0_1::measure
