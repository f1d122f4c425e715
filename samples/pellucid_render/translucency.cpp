// SPDX-License-Identifier: MIT
#include "translucency.hpp"
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

using namespace pellucid;
using nlohmann::ordered_json;

LayerSummary summarize_layers(const measure::LayerCounts& counts) {
    LayerSummary out;
    for (const std::uint32_t n : counts.data) {
        out.fragments += n;
        out.covered_pixels += n > 0 ? 1 : 0;
        out.max = std::max(out.max, n);
    }
    out.histogram.resize(std::min<std::size_t>(out.max + std::size_t{1}, LayerSummary::most_bins));
    for (const std::uint32_t n : counts.data) ++out.histogram[std::min<std::size_t>(n, LayerSummary::most_bins - 1)];
    return out;
}

bool has_translucent(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return scene.materials[scene.meshes[instance.mesh].material].alpha_mode == AlphaMode::blend;
    });
}

TranslucencyReport report_translucency(const Options& options, const Scene& scene, const Camera& camera,
                                       const TranslucencyStats& facts) {
    const Transparency method = options.settings.transparency;
    TranslucencyReport out{.method = name(method), .facts = facts};
    out.why = options.chose_transparency ? std::string("--transparency ") + name(method)
                                         : std::string("auto: ") + name(method) + " is exact for every scene";
    out.exact = facts.exact;
    if (method == Transparency::sorted) {
        out.conflicts = find_sort_conflicts(scene, camera, options.settings.size);
        out.exact = out.conflicts->exact();
    }
    if (!has_translucent(scene)) out.exact = true;
    if (!out.exact) out.loses = facts.loses;
    return out;
}

std::string error_bound(const TranslucencyReport& report) {
    if (!report.transmittance_left) return {};
    char text[160];
    std::snprintf(text, sizeof text,
                  "what was left out of a pixel is worth at most %.3g times the largest radiance behind it",
                  *report.transmittance_left);
    return text;
}

std::vector<std::string> warnings(const TranslucencyReport& report) {
    std::vector<std::string> out;
    if (report.conflicts && !report.conflicts->exact()) out.push_back(to_text(*report.conflicts));
    if (report.facts && report.facts->truncated) {
        const std::string bound = error_bound(report);
        out.push_back(report.method + " stopped at --layers, and may have lost " + report.loses +
                      (bound.empty() ? "" : ": " + bound));
    }
    return out;
}

namespace {

ordered_json to_json(const LayerSummary& layers) {
    return {{"max", layers.max},
            {"mean", layers.mean()},
            {"covered_pixels", layers.covered_pixels},
            {"histogram", layers.histogram}};
}

ordered_json to_json(const SortConflicts& c) {
    ordered_json pairs = ordered_json::array();
    for (const SortConflicts::Pair& p : c.pairs) pairs.push_back({p.first, p.second});
    return {
        {"instances", c.instances}, {"complete", c.complete},           {"pairs", c.pair_count},
        {"pairs_listed", pairs},    {"self_overlapping", c.self_count}, {"self_overlapping_listed", c.self_overlapping},
        {"text", to_text(c)}};
}

/// What a method says of its last frame, by the settings that it heeds.
ordered_json facts_of(const TranslucencyReport& report, const RenderSettings& settings) {
    ordered_json out = ordered_json::object();
    if (!report.facts || !report.facts->ran) return out;
    const TranslucencyStats& facts = *report.facts;
    const TransparencyTraits& method = traits(facts.method);
    if (method.layers) {
        if (facts.method == Transparency::dual_peel)
            out["passes"] = facts.passes;
        else
            out["layers"] = facts.layers;
        if (settings.max_layers > 0) out["max_layers"] = settings.max_layers;
        if (facts.method != Transparency::peel_seed) out["truncated"] = facts.truncated;
    }
    if (method.seed_composite) out["seed_composite"] = settings.seed_composite;
    if (method.skyx_alpha_gain) out["skyx_alpha_gain"] = settings.skyx_alpha_gain;
    if (method.memory_budget) {
        out["bands"] = facts.bands;
        out["pool_bytes"] = facts.pool_bytes;
        out["memory_budget"] = settings.memory_budget > 0 ? ordered_json(settings.memory_budget) : ordered_json();
    }
    if (method.min_transmittance) {
        out["min_transmittance"] = settings.min_transmittance;
        out["transmittance_left"] = report.transmittance_left.value_or(0);
        const std::string bound = error_bound(report);
        out["error_bound"] = bound.empty() ? ordered_json() : ordered_json(bound);
    }
    if (report.conflicts) out["conflicts"] = to_json(*report.conflicts);
    return out;
}

}  // namespace

ordered_json to_json(const TranslucencyReport& report, const RenderSettings& settings) {
    ordered_json out{{"method", report.method},
                     {"why", report.why},
                     {"exact", report.exact},
                     {"loses", report.loses.empty() ? ordered_json() : ordered_json(report.loses)}};
    if (report.layers) {
        out["layers"] = to_json(*report.layers);
        out["fragments"] = report.layers->fragments;
    }
    if (report.facts) {
        out["bytes"] = report.facts->bytes;
        out[report.method] = facts_of(report, settings);
    }
    if (report.audit) out["audit"] = ordered_json::parse(measure::to_json(*report.audit));
    return out;
}
