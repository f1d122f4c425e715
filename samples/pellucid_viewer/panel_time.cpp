// SPDX-License-Identifier: MIT
#include "panel_parts.hpp"
#include "widgets.hpp"
#include <algorithm>

namespace pellucid::samples::viewer {
namespace {

void plot(const char* id, const char* what, const Ring& ring) {
    char text[96];
    std::snprintf(text, sizeof text, "%s: %.4g ms, median %.4g, most %.4g", what, static_cast<double>(ring.last()),
                  ring.median(), static_cast<double>(ring.max()));
    ImGui::TextUnformatted(text);
    ImGui::PlotLines(id, ring.data(), static_cast<int>(ring.count()), static_cast<int>(ring.offset()), nullptr, 0,
                     std::max(1.1f * ring.max(), 0.01f), {ImGui::GetContentRegionAvail().x, 60});
}

void pass_table(const Facts& facts) {
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("pass");
    ImGui::TableSetupColumn("median [ms]");
    ImGui::TableSetupColumn("last, or why it is left out", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (const PassReport& pass : facts.left.stats.passes) {
        const auto& timed = facts.history.passes;
        const auto at =
            std::find_if(timed.begin(), timed.end(), [&](const FrameHistory::Pass& p) { return p.name == pass.name; });
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (pass.ran)
            ImGui::TextUnformatted(pass.name);
        else
            ImGui::TextDisabled("%s", pass.name);
        ImGui::TableNextColumn();
        if (pass.ran && at != timed.end()) ImGui::Text("%.3f", at->ms.median());
        ImGui::TableNextColumn();
        if (!pass.ran)
            ImGui::TextWrapped("%s", pass.reason.c_str());
        else if (at != timed.end()) {
            char last[24];
            std::snprintf(last, sizeof last, "%.3f", static_cast<double>(at->ms.last()));
            ImGui::PushID(pass.name);
            ImGui::PlotLines("##pass", at->ms.data(), static_cast<int>(at->ms.count()),
                             static_cast<int>(at->ms.offset()), last, 0, std::max(1.1f * at->ms.max(), 0.001f),
                             {ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight()});
            ImGui::PopID();
        }
    }
    ImGui::EndTable();
}

void resource_table(const RenderStats& stats) {
    if (!ImGui::BeginTable("bytes", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("what is kept");
    ImGui::TableSetupColumn("bytes", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (const TextureReport& r : stats.resources) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(r.name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(r.shared ? "in another's place" : bytes_text(r.bytes).c_str());
    }
    ImGui::EndTable();
}

}  // namespace

void time_tab(const Facts& facts) {
    const RenderStats& stats = facts.left.stats;
    if (facts.history.gpu.count() > 0)
        plot("##gpu", "GPU", facts.history.gpu);
    else if (facts.device.timestamp_ns > 0)
        ImGui::TextWrapped("No GPU times have arrived yet.");
    else
        ImGui::TextWrapped("This device has no timestamps: the wall clock of the frame it is.");
    plot("##wall", "frame", facts.history.wall);
    hint("the wall clock, the panel and the canvas included");
    if (facts.device.software && facts.history.gpu.count() > 0)
        ImGui::TextWrapped("This device is a CPU: its timestamps need not bracket the work of a pass.");
    ImGui::Text("draws %u, triangles %llu, lights %u (%s)", stats.draws,
                static_cast<unsigned long long>(stats.triangles), stats.lights, name(stats.lighting));
    ImGui::Text("pipelines %u, memory %s", stats.pipelines, bytes_text(stats.bytes).c_str());
    const TranslucencyStats& t = stats.translucency;
    if (t.layers > 0) ImGui::Text("layers %u%s", t.layers, t.truncated ? ", some were left out" : "");
    if (t.bands > 0) ImGui::Text("bands %u, stored fragments %s", t.bands, bytes_text(t.pool_bytes).c_str());
    if (!stats.lighting_why.empty()) ImGui::TextWrapped("lights: %s", stats.lighting_why.c_str());
    if (!stats.shadows_why.empty()) ImGui::TextWrapped("shadows: %s", stats.shadows_why.c_str());
    ImGui::Spacing();
    pass_table(facts);
    if (!stats.warnings.empty() && ImGui::CollapsingHeader("warnings", ImGuiTreeNodeFlags_DefaultOpen))
        for (const std::string& warning : stats.warnings) {
            ImGui::Bullet();
            ImGui::TextWrapped("%s", warning.c_str());
        }
    if (ImGui::CollapsingHeader("memory")) resource_table(stats);
}

}  // namespace pellucid::samples::viewer
