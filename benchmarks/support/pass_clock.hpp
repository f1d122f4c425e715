// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Times passes.  GPUs: timestamps around each piece of work, all works of a round in one frame, in turn.  Software
/// devices: the clock around recording, submission and wait of one work, from an idle device, because their timestamps
/// need not bracket the work.
#include <functional>
#include <optional>
#include <pellucid/measure/gpu_timer.hpp>
#include <string>
#include <vector>
#include "support/pass_settings.hpp"
#include "support/time.hpp"

namespace pellucid::bench {

/// Something to time: whole passes.
template <rhi::Backend B>
struct Work {
    std::string name;
    std::function<void(rhi::CommandsFor<B>&)> record;
    std::uint32_t repeats = 1;  ///< times that it is recorded in a row; the time reported is that of one
};

/// [ms] of each work in each round, in the order of the works.
using RoundTimes = std::vector<std::vector<double>>;

/// One frame: `record(commands)` → Result<void>, submitted and waited for.
template <rhi::Backend B, class Record>
[[nodiscard]] Result<void> run_frame(rhi::DeviceFor<B>& device, Record&& record) {
    rhi::CommandsFor<B>* cmd = nullptr;
    PELLUCID_TRY(cmd, device.begin_frame());
    PELLUCID_CHECK(record(*cmd));
    rhi::Ticket ticket{};
    PELLUCID_TRY(ticket, device.submit());
    return device.wait(ticket);
}

/// Times every work in every round.  `begin(commands)` → Result<void> prepares a frame (uploads); it is not timed.
/// Errors: those of the device; internal where a timestamp is missing.
template <rhi::Backend B, class Begin>
[[nodiscard]] Result<RoundTimes> time_works(rhi::DeviceFor<B>& device, const PassSettings& settings,
                                            const std::vector<Work<B>>& works, Begin begin) {
    RoundTimes times(works.size());
    std::optional<measure::GpuTimer<B>> timer;
    if (settings.timestamps) {
        PELLUCID_TRY(timer,
                     measure::GpuTimer<B>::create(device, {.max_scopes = static_cast<std::uint32_t>(works.size())}));
    }
    for (std::uint32_t round = 0; round < settings.warm_up + settings.rounds; ++round) {
        const bool kept = round >= settings.warm_up;
        if (!settings.timestamps) {
            for (std::size_t i = 0; i < works.size(); ++i) {
                double start = 0;
                const auto record = [&](rhi::CommandsFor<B>& cmd) -> Result<void> {
                    PELLUCID_CHECK(begin(cmd));
                    start = now_ns();
                    for (std::uint32_t r = 0; r < works[i].repeats; ++r) works[i].record(cmd);
                    return {};
                };
                PELLUCID_CHECK(run_frame<B>(device, record));
                if (kept) times[i].push_back((now_ns() - start) * 1e-6 / works[i].repeats);
            }
            continue;
        }
        rhi::CommandsFor<B>* cmd = nullptr;
        PELLUCID_TRY(cmd, device.begin_frame());
        timer->begin_frame(*cmd);
        PELLUCID_CHECK(begin(*cmd));
        for (const Work<B>& work : works) {
            const auto scope = timer->scope(*cmd, work.name.c_str());
            for (std::uint32_t r = 0; r < work.repeats; ++r) work.record(*cmd);
        }
        rhi::Ticket ticket{};
        PELLUCID_TRY(ticket, device.submit());
        timer->end_frame(ticket);
        PELLUCID_CHECK(device.wait(ticket));
        PELLUCID_TRY(const auto spans, timer->collect());
        if (spans.size() != works.size())
            return Error{Errc::internal, "the device gave the times of " + std::to_string(spans.size()) + " of " +
                                             std::to_string(works.size()) + " works: run it again"};
        for (std::size_t i = 0; kept && i < works.size(); ++i) times[i].push_back(spans[i].ms / works[i].repeats);
    }
    return times;
}

}  // namespace pellucid::bench
