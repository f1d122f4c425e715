// SPDX-License-Identifier: MIT
#include "rhi_overhead/measure.hpp"
#include <algorithm>
#include "support/allocations.hpp"
#include "support/time.hpp"

namespace pellucid::bench {
namespace {

Result<FrameTime> checked_frame(Loop& loop, const Workload& workload, std::uint64_t number, Variant variant,
                                bool drawn) {
    PELLUCID_TRY(const FrameTime time, loop.frame(workload, number, variant));
    PELLUCID_CHECK(Workload::check(loop.picture(), number, drawn));
    return time;
}

Result<void> run_round(Loop& loop, const Workload& workload, const Settings& settings, Variant variant,
                       std::uint64_t& number, Samples& samples, bool drawn) {
    std::vector<double> record, total;
    record.reserve(settings.frames);
    total.reserve(settings.frames);
    loop.enter();
    PELLUCID_CHECK(checked_frame(loop, workload, number++, variant, drawn));
    for (std::uint32_t f = 0; f < settings.frames; ++f) {
        const std::uint64_t before = allocation_count();
        PELLUCID_TRY(const FrameTime time, checked_frame(loop, workload, number++, variant, drawn));
        samples.allocations = std::max(samples.allocations, allocation_count() - before);
        record.push_back(time.record / settings.draws);
        total.push_back(time.total / settings.draws);
    }
    samples.record.push_back(summarise(std::move(record)).lowest);
    samples.total.push_back(summarise(std::move(total)).lowest);
    return {};
}

Result<std::vector<VariantResult>> run_rounds(Loop& ours, Loop& raw, const Settings& settings, bool drawn) {
    const Workload workload(settings.draws);
    std::vector<VariantResult> results;
    for (Variant variant : variants) results.push_back({.variant = variant, .ours = {}, .raw = {}, .own_cost = {}});
    std::uint64_t ours_number = 0, raw_number = 0;
    // The first two rounds let rings grow, caches fill and clocks rise; they are thrown away.
    for (std::uint32_t round = 0; round < settings.rounds + 2; ++round) {
        if (round == 2)
            for (VariantResult& result : results) result.ours = {}, result.raw = {};
        for (VariantResult& result : results) {
            const auto run_ours = [&] {
                return run_round(ours, workload, settings, result.variant, ours_number, result.ours, drawn);
            };
            const auto run_raw = [&] {
                return run_round(raw, workload, settings, result.variant, raw_number, result.raw, drawn);
            };
            if (round % 2 == 0) PELLUCID_CHECK(run_ours());
            PELLUCID_CHECK(run_raw());
            if (round % 2 == 1) PELLUCID_CHECK(run_ours());
        }
    }
    return results;
}

}  // namespace

Result<std::vector<VariantResult>> measure(Loop& ours, Loop& raw, const Settings& settings) {
    return run_rounds(ours, raw, settings, true);
}

Result<void> measure_muted(Loop& ours, Loop& raw, const Settings& settings, std::vector<VariantResult>& results) {
    PELLUCID_TRY(const auto muted, run_rounds(ours, raw, settings, false));
    for (std::size_t i = 0; i < results.size(); ++i)
        results[i].own_cost = summarise(differences(muted[i].ours.record, muted[i].raw.record));
    return {};
}

Result<void> count_calls(Loop& ours, Loop& raw, const Settings& settings, std::vector<VariantResult>& results) {
    const Workload workload(settings.draws);
    for (VariantResult& result : results)
        for (Loop* loop : {&ours, &raw}) {
            loop->enter();
            std::uint64_t before = 0;
            for (std::uint64_t number = 0; number < 4; ++number) {
                before = loop->api_calls();
                PELLUCID_CHECK(checked_frame(*loop, workload, number, result.variant, true));
            }
            (loop == &ours ? result.ours : result.raw).api_calls = loop->api_calls() - before;
        }
    return {};
}

}  // namespace pellucid::bench
