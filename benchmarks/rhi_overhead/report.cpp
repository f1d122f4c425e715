// SPDX-License-Identifier: MIT
#include "rhi_overhead/measure.hpp"
#include "support/json.hpp"
#include "support/markdown.hpp"
#include "support/time.hpp"

namespace pellucid::bench {
namespace {

/// What is compared, from both loops' rounds.
struct Comparison {
    Summary total_ratio;        ///< ours / raw, record + submit + wait
    Summary record_difference;  ///< ours - raw, [ns] a draw
};
Comparison compare(const VariantResult& result) {
    return {summarise(ratios(result.ours.total, result.raw.total)),
            summarise(differences(result.ours.record, result.raw.record))};
}

std::string verdict(const char* what, double found, double limit, const char* unit) {
    return std::string("- ") + (found <= limit ? "met: " : "**missed**: ") + what + " " + significant(found) + unit +
           " (at most " + significant(limit) + unit + ")\n";
}

}  // namespace

std::string to_markdown(const std::vector<ApiResult>& results, const Settings& settings, const Machine& machine) {
    std::string out =
        "## Cost of a draw against hand-written API calls\n\n" + markdown(machine) + "- " +
        std::to_string(settings.draws) + " draws a frame, " + std::to_string(settings.rounds) + " rounds of " +
        std::to_string(settings.frames) +
        " frames, loops in turn; [ns] a draw, median [quartiles] of the fastest frames of the rounds; ratios and "
        "differences are "
        "medians of each round's own; own cost: record - raw with empty functions in place of the driver's draws\n";
    for (const ApiResult& api : results) {
        out += "\n### " + api.device.backend + ": " + api.device.name + ", " + api.device.driver + "\n\n";
        MarkdownTable table({"draw", "loop", "record", "record + submit + wait", "x raw", "record - raw", "own cost",
                             "API calls a frame", "allocations a frame"});
        std::string verdicts;
        for (const VariantResult& result : api.variants) {
            const Comparison c = compare(result);
            const auto row = [&](const char* who, const Samples& s, std::string ratio, std::string difference,
                                 std::string own) {
                table.row({name(result.variant), who, with_spread(summarise(s.record)), with_spread(summarise(s.total)),
                           std::move(ratio), std::move(difference), std::move(own), std::to_string(s.api_calls),
                           std::to_string(s.allocations)});
            };
            row("Pellucid", result.ours, with_spread(c.total_ratio), with_spread(c.record_difference),
                with_spread(result.own_cost));
            row("by hand", result.raw, "1", "0", "0");
            // Push data is for passes that draw once: its cost a draw is told, not judged.
            if (result.variant == Variant::push) continue;
            const std::string title = name(result.variant);
            verdicts += verdict((title + ": total / raw").c_str(), c.total_ratio.median, api.total_target, "");
            verdicts +=
                verdict((title + ": record - raw").c_str(), c.record_difference.median, record_target_ns, " ns");
            verdicts +=
                verdict((title + ": allocations a frame").c_str(), static_cast<double>(result.ours.allocations), 0, "");
        }
        out += table.text() + "\n" + verdicts;
    }
    return out;
}

std::string to_json(const std::vector<ApiResult>& results, const Settings& settings, const Machine& machine) {
    JsonWriter json;
    json.begin_object();
    json.member("benchmark", "rhi_overhead").member("unit", "ns per draw");
    json.member("draws", settings.draws).member("rounds", settings.rounds).member("frames", settings.frames);
    write(json.key("machine"), machine);
    json.key("results").begin_array();
    for (const ApiResult& api : results)
        for (const VariantResult& result : api.variants) {
            const Comparison c = compare(result);
            const auto samples = [&](const char* key, const Samples& s) {
                json.key(key).begin_object();
                json.member("record", summarise(s.record)).member("total", summarise(s.total));
                json.member("api_calls", s.api_calls).member("allocations", s.allocations);
                json.end_object();
            };
            json.begin_object();
            write(json.key("device"), api.device);
            json.member("variant", name(result.variant));
            samples("ours", result.ours);
            samples("raw", result.raw);
            json.member("total_ratio", c.total_ratio).member("total_ratio_target", api.total_target);
            json.member("own_cost", result.own_cost);
            json.member("record_difference", c.record_difference).member("record_difference_target", record_target_ns);
            json.end_object();
        }
    json.end_array();
    json.end_object();
    return json.text();
}

}  // namespace pellucid::bench
