// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What is told about the transparency of a picture: which method and why, what it loses, and how many layers there
/// are.
#include "options.hpp"
#include <pellucid/measure/coverage.hpp>
#include <pellucid/renderer/translucent.hpp>
#include <pellucid/scene/sort_conflicts.hpp>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

struct LayerSummary {
    static constexpr std::size_t most_bins = 65;
    std::uint64_t fragments = 0;
    std::uint64_t covered_pixels = 0;  ///< with at least one
    std::uint32_t max = 0;
    /// Pixels with 0, 1, 2, … layers up to the most there are; the 65th entry, if there is one, is of 64 and more.
    std::vector<std::uint64_t> histogram;
    [[nodiscard]] double mean() const {
        return covered_pixels > 0 ? static_cast<double>(fragments) / static_cast<double>(covered_pixels) : 0;
    }
};
LayerSummary summarize_layers(const pellucid::measure::LayerCounts& counts);

/// Whether anything of the scene blends.
bool has_translucent(const pellucid::Scene& scene);

struct TranslucencyReport {
    std::string method, why;
    bool exact = true;
    std::string loses;  ///< what may be missing or out of place; empty where `exact`
    std::optional<LayerSummary> layers;
    std::optional<pellucid::TranslucencyStats> facts;         ///< of a method on a device
    std::optional<double> transmittance_left;                 ///< where something was left out, if there is a bound
    std::optional<pellucid::SortConflicts> conflicts;         ///< of sorted
    std::optional<pellucid::measure::LayerDifference> audit;  ///< composited against counted
};

/// What follows from the options, the scene and what the renderer says.
TranslucencyReport report_translucency(const Options& options, const pellucid::Scene& scene,
                                       const pellucid::Camera& camera, const pellucid::TranslucencyStats& facts);
/// One sentence for each thing that a user of this picture should know.
std::vector<std::string> warnings(const TranslucencyReport& report);
/// The bound of what was left out, or nothing.
std::string error_bound(const TranslucencyReport& report);
nlohmann::ordered_json to_json(const TranslucencyReport& report, const pellucid::RenderSettings& settings);
