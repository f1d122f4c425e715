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

/// A further number of a row: a column of its own, by its name.
struct NamedNumber {
    std::string name;  ///< with its unit
    double value = 0;
};

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
    std::vector<NamedNumber> more = {};
};

struct SpeedErrorTable {
    std::string stem;        ///< of the pass
    std::string baseline;    ///< what ratio 1 is
    rhi::DeviceInfo device;  ///< without a backend: errors alone, no times
    Machine machine;
    Extent2D size;  ///< [pixel]
    std::vector<SpeedErrorRow> rows;
    std::string error = "linear";         ///< what rmse, p999 and max_error are of, and their unit
    std::vector<std::string> notes = {};  ///< a sentence each: how the numbers were made
};

/// The names of all further columns, in the order in which rows first have them.
[[nodiscard]] inline std::vector<std::string> further_columns(const SpeedErrorTable& table) {
    std::vector<std::string> out;
    for (const SpeedErrorRow& row : table.rows)
        for (const NamedNumber& number : row.more)
            if (std::find(out.begin(), out.end(), number.name) == out.end()) out.push_back(number.name);
    return out;
}

/// Writes the table as one JSON object, where a value is expected.
inline void write(JsonWriter& json, const SpeedErrorTable& table) {
    json.begin_object();
    json.member("benchmark", table.stem).member("baseline", table.baseline);
    json.member("width", table.size.width).member("height", table.size.height);
    write(json.key("device"), table.device);
    write(json.key("machine"), table.machine);
    json.member("error", table.error);
    json.key("notes").begin_array();
    for (const std::string& note : table.notes) json.value(note);
    json.end_array();
    json.key("rows").begin_array();
    for (const SpeedErrorRow& row : table.rows) {
        json.begin_object();
        json.member("scene", row.scene).member("method", row.method).member("setting", row.setting);
        json.member("milliseconds", row.milliseconds).member("ratio", row.ratio).member("rmse", row.rmse);
        json.member("p999", row.p999).member("max_error", row.max_error).member("bytes", row.bytes);
        for (const NamedNumber& number : row.more) json.member(number.name, number.value);
        json.end_object();
    }
    json.end_array();
    json.end_object();
}

[[nodiscard]] inline std::string to_json(const SpeedErrorTable& table) {
    JsonWriter json;
    write(json, table);
    return json.text();
}

[[nodiscard]] inline std::string to_markdown(const SpeedErrorTable& table) {
    const std::vector<std::string> further = further_columns(table);
    std::vector<std::string> header = {
        "scene", "method", "ms, median [quartiles]", "x " + table.baseline, "RMSE", "p99.9", "max", "MiB"};
    header.insert(header.end(), further.begin(), further.end());
    MarkdownTable out(header);
    for (const SpeedErrorRow& row : table.rows) {
        std::vector<std::string> cells = {row.scene,
                                          row.method + (row.setting.empty() ? "" : ", " + row.setting),
                                          with_spread(row.milliseconds),
                                          row.ratio > 0 ? significant(row.ratio) : "–",
                                          significant(row.rmse),
                                          significant(row.p999),
                                          significant(row.max_error),
                                          significant(static_cast<double>(row.bytes) / (1024.0 * 1024.0))};
        for (const std::string& name : further) {
            const auto found =
                std::find_if(row.more.begin(), row.more.end(), [&](const auto& number) { return number.name == name; });
            cells.push_back(found == row.more.end() ? "–" : significant(found->value));
        }
        out.row(std::move(cells));
    }
    const std::string where = table.device.backend.empty() ? "without a device"
                                                           : table.device.backend + " on " + table.device.name + " (" +
                                                                 table.device.driver + ")";
    std::string text = "### " + table.stem + ", " + std::to_string(table.size.width) + " x " +
                       std::to_string(table.size.height) + ", " + where + "\n\n" + markdown(table.machine) +
                       "- error: " + table.error + "\n";
    for (const std::string& note : table.notes) text += "- " + note + "\n";
    return text + "\n" + out.text();
}

/// Milliseconds against RMSE for the rows of one scene, or of all where `scene` is empty; a method's settings are
/// joined by a line.
[[nodiscard]] inline std::string to_svg(const SpeedErrorTable& table, const std::string& scene = {}) {
    Plot plot{.title = table.stem + ": " + (scene.empty() ? table.device.backend : scene) + ", " + table.device.name,
              .x_label = "time [ms]",
              .y_label = "RMSE, " + table.error,
              .series = {}};
    for (const SpeedErrorRow& row : table.rows) {
        if (!scene.empty() && row.scene != scene) continue;
        const std::string name = scene.empty() ? row.scene + ", " + row.method : row.method;
        auto found =
            std::find_if(plot.series.begin(), plot.series.end(), [&](const auto& s) { return s.name == name; });
        if (found == plot.series.end())
            found = plot.series.insert(found, {.name = name, .points = {}, .connected = true});
        found->points.push_back({row.milliseconds.median, row.rmse, row.setting});
    }
    return to_svg(plot);
}

}  // namespace pellucid::bench
