// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The results as Markdown, JSON and a sheet of plots.
#include "support/markdown.hpp"
#include "support/svg.hpp"
#include "transparency/results.hpp"

namespace pellucid::bench {

namespace detail {

/// "up to 48, 15.3 in the 97.8 % of pixels that have any".
[[nodiscard]] inline std::string layers_text(const Truth& truth) {
    return "up to " + std::to_string(truth.max_layers) + ", " + significant(truth.mean_layers) + " in the " +
           significant(100 * truth.covered) + " % of pixels that have any";
}

/// What a row has to say beyond its numbers: the remark, and the passes where there are several.
[[nodiscard]] inline std::string remarks(const MethodRow& row) {
    std::string out = row.remark;
    std::vector<std::string> parts;
    for (const PassTime& pass : row.passes)
        if (row.kind == RowKind::opaque || of_transparency(pass.name.c_str()))
            parts.push_back(pass.name + " " + significant(pass.milliseconds.median));
    if (row.kind == RowKind::method && row.added_light.median > 0.02 * row.transparency.median)
        parts.push_back("light " + significant(row.added_light.median));
    if (parts.size() < 2) return out;
    out += out.empty() ? "" : "; ";
    for (std::size_t i = 0; i < parts.size(); ++i) out += (i ? " + " : "") + parts[i];
    return out;
}

/// 130, "15 k", "1.0 M".
[[nodiscard]] inline std::string thousands(std::uint64_t count) {
    const auto n = static_cast<double>(count);
    return n < 1e4 ? std::to_string(count) : n < 1e6 ? significant(n / 1e3, 2) + " k" : significant(n / 1e6, 2) + " M";
}

[[nodiscard]] inline std::string api_name(const rhi::DeviceInfo& device) {
    return device.backend == "vulkan" ? "Vulkan" : device.backend == "opengl" ? "OpenGL" : device.backend;
}

[[nodiscard]] inline std::string decibel(double psnr) {
    return std::isfinite(psnr) ? significant(psnr) : psnr > 0 ? "∞" : "–";
}

}  // namespace detail

[[nodiscard]] inline std::string to_markdown(const SceneResult& scene) {
    const Truth& truth = *scene.truth;
    std::string text = "#### " + scene.title + "\n\n- " + std::to_string(scene.triangles) +
                       " triangles; translucent layers: " + detail::layers_text(truth) +
                       "\n- stored in binary16, the reference itself has a scaled RMSE of " + significant(truth.floor) +
                       "; " + std::to_string(truth.unstable) + " of " + std::to_string(truth.stable.data.size()) +
                       " pixels are on an edge and left out of all errors\n";
    for (const std::string& note : scene.notes) text += "- " + note + "\n";
    const bool peers =
        std::any_of(scene.rows.begin(), scene.rows.end(), [](const MethodRow& row) { return row.peer_ratio > 0; });
    std::vector<std::string> header = {"method", "ms, median [quartiles]", "lowest", "x sorted"};
    if (peers) header.push_back("x VTK dual-peel");
    header.insert(header.end(), {"transparency ms", "RMSE", "scaled RMSE", "scaled max", "scaled p99.9", "FLIP",
                                 "PSNR dB", "MiB (own)", "notes"});
    MarkdownTable table(header);
    const auto number = [](double value, bool known) { return known ? significant(value) : std::string("–"); };
    const auto mib = [](std::uint64_t bytes) { return significant(static_cast<double>(bytes) / (1024.0 * 1024.0)); };
    for (const MethodRow& row : scene.rows) {
        const measure::QualityReport& q = row.quality;
        std::vector<std::string> cells = {row.method, with_spread(row.frame), significant(row.frame.lowest),
                                          number(row.ratio, row.ratio > 0)};
        if (peers) cells.push_back(number(row.peer_ratio, row.peer_ratio > 0));
        for (const std::string& cell :
             {number(row.transparency.median, row.transparency.count > 0), significant(q.absolute->rmse),
              significant(q.scaled->rmse), significant(q.scaled->max), significant(q.scaled->p999),
              significant(q.ldr_flip->mean), detail::decibel(q.tone_mapped_psnr->psnr),
              row.kind == RowKind::peer ? std::string("–") : mib(row.bytes) + " (" + mib(row.own_bytes) + ")",
              detail::remarks(row)})
            cells.push_back(cell);
        table.row(std::move(cells));
    }
    return text + "\n" + table.text();
}

/// The heading that a backend's scenes stand under.
[[nodiscard]] inline std::string heading(const BackendResult& result) {
    std::string text = "### transparency, " + std::to_string(result.size.width) + " x " +
                       std::to_string(result.size.height) + ", " + result.device.backend + " on " + result.device.name +
                       " (" + result.device.driver + ")\n\n" + markdown(result.machine) +
                       "- ms: the clock around a whole frame and the wait for it, " + std::to_string(result.rounds) +
                       " rounds after " + std::to_string(result.warm_up) +
                       " to warm up; x sorted: median of the rounds' ratios\n- transparency ms: " +
                       (result.timestamps ? "GPU timestamps of its passes, and what it adds to the lighting pass"
                                          : "what the frame takes longer than without translucent surfaces") +
                       "\n- RMSE: linear radiance, absolute; scaled: by max(1, reference); FLIP: mean of LDR-FLIP; "
                       "MiB: own is what there is not without translucent surfaces\n";
    for (const std::string& note : result.notes) text += "- " + note + "\n";
    return text;
}

inline void write(JsonWriter& json, const MethodRow& row) {
    constexpr const char* kinds[] = {"opaque", "method", "peer"};
    json.begin_object();
    json.member("method", row.method).member("kind", kinds[static_cast<std::size_t>(row.kind)]);
    json.member("remark", row.remark).member("milliseconds", row.frame);
    if (row.ratio > 0) json.member("ratio", row.ratio);
    if (row.peer_ratio > 0) json.member("ratio_to_vtk_dual_peel", row.peer_ratio);
    if (row.transparency.count) json.member("transparency_milliseconds", row.transparency);
    if (row.added_light.count) json.member("added_light_milliseconds", row.added_light);
    json.key("passes").begin_object();
    for (const PassTime& pass : row.passes) json.member(pass.name, pass.milliseconds);
    json.end_object();
    const measure::QualityReport& q = row.quality;
    json.member("rmse", q.absolute->rmse).member("p999", q.absolute->p999).member("max", q.absolute->max);
    json.member("scaled_rmse", q.scaled->rmse).member("scaled_p999", q.scaled->p999);
    json.member("scaled_max", q.scaled->max).member("nonfinite", q.scaled->nonfinite);
    json.member("ldr_flip_mean", q.ldr_flip->mean).member("psnr", q.tone_mapped_psnr->psnr);
    json.member("unstable_scaled_rmse", q.coverage->unstable.rmse);
    if (row.added_error > 0) json.member("added_error", row.added_error);
    if (row.kind != RowKind::peer)
        json.member("bytes", row.bytes).member("own_bytes", row.own_bytes).member("draws", row.draws);
    json.end_object();
}

inline void write(JsonWriter& json, const SceneResult& scene) {
    const Truth& truth = *scene.truth;
    json.begin_object();
    json.member("scene", scene.name).member("title", scene.title).member("triangles", scene.triangles);
    json.member("max_layers", truth.max_layers).member("mean_layers", truth.mean_layers);
    json.member("covered", truth.covered).member("fragments", truth.fragments);
    json.member("pixels", truth.stable.data.size()).member("unstable_pixels", truth.unstable);
    json.member("binary16_floor_scaled_rmse", truth.floor).member("reference_seconds", truth.seconds);
    json.member("exact_bound", scene.exact_bound);
    json.key("notes").begin_array();
    for (const std::string& note : scene.notes) json.value(note);
    json.end_array();
    json.key("rows").begin_array();
    for (const MethodRow& row : scene.rows) write(json, row);
    json.end_array();
    json.end_object();
}

/// Writes a backend's results as one JSON object, where a value is expected.
inline void write(JsonWriter& json, const BackendResult& result) {
    json.begin_object();
    json.member("benchmark", "transparency").member("baseline", name(methods[0].value));
    json.member("width", result.size.width).member("height", result.size.height);
    write(json.key("device"), result.device);
    write(json.key("machine"), result.machine);
    json.member("rounds", result.rounds).member("warm_up", result.warm_up);
    json.member("transparency_clock", result.timestamps ? "timestamps" : "difference to opaque surfaces alone");
    json.key("notes").begin_array();
    for (const std::string& note : result.notes) json.value(note);
    json.end_array();
    json.key("scenes").begin_array();
    for (const SceneResult& scene : result.scenes) write(json, scene);
    json.end_array();
    json.end_object();
}

/// A panel a scene: frame time against scaled RMSE.  The error axes are alike, so that scenes can be compared.
[[nodiscard]] inline PlotSheet to_sheet(const BackendResult& result) {
    PlotSheet sheet{.title = "Transparency: what a frame takes, and how wrong it is",
                    .subtitle = result.device.name + ", " + detail::api_name(result.device) + ", " +
                                std::to_string(result.size.width) + " × " + std::to_string(result.size.height) +
                                " pixels; lower left is better",
                    .panels = {}};
    double low = INFINITY, high = 0;
    for (const SceneResult& scene : result.scenes) {
        const Truth& truth = *scene.truth;
        Plot panel{.title = scene.title,
                   .x_label = "frame [ms]",
                   .y_label = "RMSE, scaled by max(1, reference)",
                   .series = {},
                   .remark = std::to_string(truth.max_layers) + " layers, " + detail::thousands(scene.triangles) +
                             " triangles",
                   .floor = truth.floor,
                   .floor_label = "16-bit floor"};
        for (const MethodRow& row : scene.rows) {
            if (row.kind == RowKind::opaque) continue;
            panel.series.push_back({.name = row.method,
                                    .points = {{row.frame.median, row.quality.scaled->rmse, ""}},
                                    .guest = row.kind == RowKind::peer});
            high = std::max(high, row.quality.scaled->rmse);
        }
        low = std::min(low, truth.floor);
        sheet.panels.push_back(std::move(panel));
    }
    for (Plot& panel : sheet.panels) panel.y_low = low / 2, panel.y_high = 1.5 * high;  // room for labels
    return sheet;
}

}  // namespace pellucid::bench
