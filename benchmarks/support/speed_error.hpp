// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The product of a pass's benchmark: how long each method takes and how wrong it is, as JSON (for the automatic
/// choice and for comparing runs), as a Markdown table and as an SVG plot.
#include <string>
#include <vector>
#include "support/json.hpp"
#include "support/machine.hpp"
#include "support/markdown.hpp"
#include "support/svg.hpp"

namespace pellucid::bench {

/// One method with one setting on one scene.
struct SpeedErrorRow {
    std::string scene;
    std::string method;   ///< "depth_peeling"
    std::string setting;  ///< "8 layers"; empty where there is nothing to set
    Summary milliseconds;
    double ratio = 0;         ///< to the run's baseline, the median of per-round ratios; 0: it has none
    double rmse = 0;          ///< against the double-precision reference, linear, before tone mapping
    double p999 = 0;          ///< 99.9th percentile of the absolute error
    double max_error = 0;     ///< largest absolute error
    std::uint64_t bytes = 0;  ///< GPU memory that the method holds
};

struct SpeedErrorTable {
    std::string stem;      ///< of the pass
    std::string baseline;  ///< what ratio 1 is
    rhi::DeviceInfo device;
    Machine machine;
    Extent2D size;  ///< [pixel]
    std::vector<SpeedErrorRow> rows;
};

[[nodiscard]] inline std::string to_json(const SpeedErrorTable& table) {
    JsonWriter json;
    json.begin_object();
    json.member("benchmark", table.stem).member("baseline", table.baseline);
    json.member("width", table.size.width).member("height", table.size.height);
    write(json.key("device"), table.device);
    write(json.key("machine"), table.machine);
    json.key("rows").begin_array();
    for (const SpeedErrorRow& row : table.rows) {
        json.begin_object();
        json.member("scene", row.scene).member("method", row.method).member("setting", row.setting);
        json.member("milliseconds", row.milliseconds).member("ratio", row.ratio).member("rmse", row.rmse);
        json.member("p999", row.p999).member("max_error", row.max_error).member("bytes", row.bytes);
        json.end_object();
    }
    json.end_array();
    json.end_object();
    return json.text();
}

[[nodiscard]] inline std::string to_markdown(const SpeedErrorTable& table) {
    MarkdownTable out(
        {"scene", "method", "ms, median [quartiles]", "x " + table.baseline, "RMSE", "p99.9", "max", "MiB"});
    for (const SpeedErrorRow& row : table.rows)
        out.row({row.scene, row.method + (row.setting.empty() ? "" : ", " + row.setting), with_spread(row.milliseconds),
                 row.ratio > 0 ? significant(row.ratio) : "–", significant(row.rmse), significant(row.p999),
                 significant(row.max_error), significant(static_cast<double>(row.bytes) / (1024.0 * 1024.0))});
    return "### " + table.stem + ", " + std::to_string(table.size.width) + " x " + std::to_string(table.size.height) +
           ", " + table.device.name + " (" + table.device.driver + ")\n\n" + markdown(table.machine) + "\n" +
           out.text();
}

/// Milliseconds against RMSE for the rows of one scene; a method's settings are joined by a line.
[[nodiscard]] inline std::string to_svg(const SpeedErrorTable& table, const std::string& scene) {
    Plot plot{.title = table.stem + ": " + scene + ", " + table.device.name,
              .x_label = "time [ms]",
              .y_label = "RMSE, linear",
              .series = {}};
    for (const SpeedErrorRow& row : table.rows) {
        if (row.scene != scene) continue;
        auto found =
            std::find_if(plot.series.begin(), plot.series.end(), [&](const auto& s) { return s.name == row.method; });
        if (found == plot.series.end())
            found = plot.series.insert(found, {.name = row.method, .points = {}, .connected = true});
        found->points.push_back({row.milliseconds.median, row.rmse, row.setting});
    }
    return to_svg(plot);
}

}  // namespace pellucid::bench
