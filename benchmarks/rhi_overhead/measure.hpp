// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Runs two loops in turn and keeps what they took, round by round.
#include <pellucid/rhi/desc.hpp>
#include <string>
#include <vector>
#include "rhi_overhead/loop.hpp"
#include "support/machine.hpp"
#include "support/time.hpp"

namespace pellucid::bench {

struct Settings {
    std::uint32_t draws = 10000;  ///< a frame
    std::uint32_t rounds = 31;    ///< each gives one number a loop: its fastest frame, which was disturbed least
    std::uint32_t frames = 5;     ///< timed frames a round, after one that is not timed
};

/// One loop's numbers, one a round, [ns] a draw.
struct Samples {
    std::vector<double> record, total;
    std::uint64_t api_calls = 0;    ///< of one frame, counted in a run of its own
    std::uint64_t allocations = 0;  ///< operator new calls on the recording thread, the largest of any timed frame
};
struct VariantResult {
    Variant variant = Variant::records;
    Samples ours, raw;
    Summary own_cost;  ///< [ns] a draw: recording of ours - raw with the driver's calls muted
};
struct ApiResult {
    rhi::DeviceInfo device;
    double total_target = 0;  ///< largest ratio of ours to raw that the project accepts
    std::vector<VariantResult> variants;
};
inline constexpr double record_target_ns = 5;  ///< largest accepted recording cost of a draw above the raw loop

/// Times both loops in turn, in alternating order, and checks every frame's picture: a wrong one is an error.
Result<std::vector<VariantResult>> measure(Loop& ours, Loop& raw, const Settings& settings);

/// The same with muted devices (muted.hpp), into `own_cost` of `results`.
Result<void> measure_muted(Loop& ours, Loop& raw, const Settings& settings, std::vector<VariantResult>& results);

/// Counts each loop's API calls in one settled frame, into `results`.  Both loops' devices count.
Result<void> count_calls(Loop& ours, Loop& raw, const Settings& settings, std::vector<VariantResult>& results);

/// The tables, and which targets were met.
[[nodiscard]] std::string to_markdown(const std::vector<ApiResult>& results, const Settings& settings,
                                      const Machine& machine);
[[nodiscard]] std::string to_json(const std::vector<ApiResult>& results, const Settings& settings,
                                  const Machine& machine);

}  // namespace pellucid::bench
