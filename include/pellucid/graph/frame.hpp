// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The frame that passes are recorded into: one or more command lists, one submission each.
#include <pellucid/rhi/backend.hpp>

namespace pellucid::inline v0_1 {

/// open → record → (flush → record)… → close.  Who needs to do something whenever a command list begins or ends (upload
/// the frame's data, time it) derives from it.
template <rhi::Backend B>
class Frame {
public:
    explicit Frame(typename B::Device& device) : device_(&device) {}
    virtual ~Frame() = default;
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    /// Begins a command list.  Errors: those of the device, of `opened`.
    [[nodiscard]] Result<void> open() {
        PELLUCID_TRY(commands_, device_->begin_frame());
        return opened(*commands_);
    }
    [[nodiscard]] typename B::Commands& commands() { return *commands_; }
    /// Not before `open`, after `close`, and where an error came between two command lists.
    [[nodiscard]] bool is_open() const noexcept { return commands_ != nullptr; }
    /// Submits what has been recorded, waits until it is done, so that the CPU can read what the GPU found out, and
    /// begins the next list.  Outside passes.  The CPU and the GPU run in turn from here on: a cost to be stated.
    [[nodiscard]] Result<void> flush() {
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, close());
        PELLUCID_CHECK(device_->wait(ticket));
        PELLUCID_CHECK(waited());
        return open();
    }
    /// Submits the last command list.
    [[nodiscard]] Result<rhi::Ticket> close() {
        closing(*commands_);
        commands_ = nullptr;
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, device_->submit());
        closed(ticket);
        return ticket;
    }
    /// After an error: submits the command list that is open, if one is, so that the device can begin another one.
    /// Outside passes.
    void abandon() {
        if (is_open()) (void)close();
    }

protected:
    virtual Result<void> opened(typename B::Commands&) { return {}; }
    virtual void closing(typename B::Commands&) {}
    virtual void closed(rhi::Ticket) {}
    virtual Result<void> waited() { return {}; }  ///< in a flush: the work of the last list is done

private:
    typename B::Device* device_;
    typename B::Commands* commands_ = nullptr;
};

}  // namespace pellucid::inline v0_1
