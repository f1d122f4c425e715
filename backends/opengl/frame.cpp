// SPDX-License-Identifier: MIT
// Frames, fences and tickets.
#include "pellucid/opengl/device.hpp"
#include "program_cache.hpp"
#include "text.hpp"

namespace pellucid::inline v0_1::opengl {

Error Device::lost_error() const {
    return {Errc::device_lost,
            text("The OpenGL device '%s' was reset: destroy it and make a new one", info_.name.c_str())};
}

Result<Commands*> Device::begin_frame() {
    PELLUCID_CHECK(enter());
    if (in_frame_) return Error{Errc::invalid_argument, "begin_frame was called twice without submit between"};
    PELLUCID_CHECK(wait_for(fences_[slot_]));
    commands_.begin_frame(slot_);
    in_frame_ = true;
    return &commands_;
}

Result<rhi::Ticket> Device::submit() {
    PELLUCID_CHECK(enter());
    if (!in_frame_) return Error{Errc::invalid_argument, "submit was called without begin_frame"};
    in_frame_ = false;
    // What shaders and copies wrote to mapped memory is for the CPU to see once the fence is passed.
    if (commands_.mapped_written_) glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    Fence& fence = fences_[slot_];
    fence = {.sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0), .ticket = ++submitted_};
    glFlush();
    slot_ = (slot_ + 1) % frames_in_flight_;
    if (!fence.sync || glGetGraphicsResetStatus() != GL_NO_ERROR) {
        lost_ = true;
        return lost_error();
    }
    if (commands_.failed_) {
        commands_.failed_ = false;
        return std::move(commands_.failure_);
    }
    return rhi::Ticket{submitted_};
}

Result<void> Device::wait_for(Fence& fence) {
    if (!fence.sync) return {};
    constexpr GLuint64 second = 1'000'000'000;
    for (;;) {
        const GLenum status = glClientWaitSync(fence.sync, GL_SYNC_FLUSH_COMMANDS_BIT, second);
        if (status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) break;
        if (status == GL_WAIT_FAILED || glGetGraphicsResetStatus() != GL_NO_ERROR) {
            lost_ = true;
            return lost_error();
        }
    }
    glDeleteSync(fence.sync);
    fence.sync = nullptr;
    if (fence.ticket > completed_) completed_ = fence.ticket;
    return {};
}

Result<void> Device::wait(rhi::Ticket ticket) {
    PELLUCID_CHECK(enter());
    const auto number = static_cast<std::uint64_t>(ticket);
    if (number > submitted_)
        return Error{Errc::invalid_argument,
                     text("wait got the ticket %llu; the last one submitted is %llu",
                          static_cast<unsigned long long>(number), static_cast<unsigned long long>(submitted_))};
    if (number <= completed_) return {};
    for (Fence& fence : fences_)
        if (fence.ticket == number) return wait_for(fence);
    return Error{Errc::internal, text("The fence of ticket %llu is gone", static_cast<unsigned long long>(number))};
}

bool Device::done(rhi::Ticket ticket) {
    const auto number = static_cast<std::uint64_t>(ticket);
    if (number <= completed_) return true;
    if (lost_ || !context_->enter()) return false;
    for (Fence& fence : fences_) {
        if (fence.ticket != number || !fence.sync) continue;
        const GLenum status = glClientWaitSync(fence.sync, 0, 0);
        if (status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) completed_ = number;
    }
    return number <= completed_;
}

}  // namespace pellucid::inline v0_1::opengl
