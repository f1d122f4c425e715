// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The bandwidth floor: the least time that moving a pass's bytes can take, from a device copy in the same run.
#include <pellucid/rhi/unique.hpp>
#include "support/pass_clock.hpp"

namespace pellucid::bench {

/// A copy of `PassSettings::copied` bytes between two buffers.  Buffers hold no defined content, and need none.
template <rhi::Backend B>
struct CopyFloor {
    rhi::Unique<rhi::DeviceFor<B>, rhi::Buffer> from, to;
    std::uint64_t bytes = 0;

    [[nodiscard]] static Result<CopyFloor> create(rhi::DeviceFor<B>& device, const PassSettings& settings) {
        CopyFloor out;
        out.bytes = settings.copied;
        PELLUCID_OWN(out.from, device,
                     device.make_buffer(
                         {.size = out.bytes, .usage = rhi::BufferUsage::copy_source, .debug_name = "floor.from"}));
        PELLUCID_OWN(out.to, device,
                     device.make_buffer(
                         {.size = out.bytes, .usage = rhi::BufferUsage::copy_destination, .debug_name = "floor.to"}));
        return out;
    }
    [[nodiscard]] Work<B> work() const {
        return {.name = "device copy", .record = [this](rhi::CommandsFor<B>& cmd) {
                    cmd.begin_copy({.uses = {rhi::use(from.get(), rhi::Access::copy_read),
                                             rhi::use(to.get(), rhi::Access::copy_write)},
                                    .name = "device copy"});
                    cmd.copy(from.get(), to.get(), rhi::BufferCopy{.size = bytes});
                    cmd.end_copy();
                }};
    }
    /// [ms] round by round: moving `moved` bytes (read and written, each counted) at the rate of the copy that took
    /// `copy` [ms], or at the rate that the user gave.
    [[nodiscard]] std::vector<double> floor(const PassSettings& settings, std::vector<double> copy,
                                            double moved) const {
        for (double& ms : copy)
            ms = settings.bandwidth > 0 ? moved / settings.bandwidth * 1e3
                                        : ms * moved / (2.0 * static_cast<double>(bytes));
        return copy;
    }
    /// A sentence for the notes of a table.
    [[nodiscard]] std::string note(const PassSettings& settings, const std::vector<double>& copy) const {
        const double rate = 2.0 * static_cast<double>(bytes) / summarise(copy).median * 1e-9;  // bytes/ms → TB/s
        char text[256];
        std::snprintf(text, sizeof text,
                      "floor: %.3g TB/s (%s); the device copy of %llu MiB in this run: %.3g TB/s, read and written "
                      "bytes both counted; data that fits the last cache can be faster",
                      settings.bandwidth > 0 ? settings.bandwidth * 1e-12 : rate,
                      settings.bandwidth > 0 ? "given" : "the device copy",
                      static_cast<unsigned long long>(bytes >> 20u), rate);
        return text;
    }
};

}  // namespace pellucid::bench
