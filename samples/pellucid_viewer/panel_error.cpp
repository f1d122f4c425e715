// SPDX-License-Identifier: MIT
#include "panel_parts.hpp"
#include "widgets.hpp"
#include <cmath>

namespace pellucid::samples::viewer {
namespace {

void numbers(const Quality& q, bool old) {
    ImGui::TextWrapped("%s against %s%s", q.test.c_str(), q.truth.c_str(), old ? " (before the last change)" : "");
    if (!ImGui::BeginTable("quality", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    const auto row = [](const char* what, const char* format, auto value) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what);
        ImGui::TableNextColumn();
        ImGui::Text(format, value);
    };
    ImGui::TableSetupColumn("what");
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
    row("RMSE of radiance", "%.3g", q.rmse);
    row("largest error", "%.3g", q.max);
    if (std::isfinite(q.psnr))
        row("PSNR, tone-mapped", "%.1f dB", q.psnr);
    else
        row("PSNR, tone-mapped", "%s", "equal");
    row("FLIP, mean", "%.4f", q.flip);
    row("pixels with other bits", "%llu", static_cast<unsigned long long>(q.different));
    if (q.nonfinite > 0) row("values not finite", "%llu", static_cast<unsigned long long>(q.nonfinite));
    ImGui::EndTable();
}

}  // namespace

void error_tab(const Facts& facts, Choices& choices, Requests& requests) {
    ImGui::BeginDisabled(facts.measuring.has_value());
    if (ImGui::Button("measure")) requests.measure = true;
    hint("time and error of these settings, against the right picture, or an exact one where there is none");
    ImGui::SameLine();
    if (ImGui::Button("measure every method")) requests.measure_all = true;
    hint("the same settings with each method in turn, one a frame");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::Checkbox("at rest", &choices.measure_at_rest);
    hint("measure by itself when the camera has stood still for half a second and there is a right picture");
    if (choices.against == Against::reference) {
        if (facts.reference) {
            if (ImGui::Button("cancel the reference")) requests.cancel_reference = true;
        } else {
            if (ImGui::Button("draw the reference again")) requests.draw_reference = true;
            if (facts.reference_is_old) {
                ImGui::SameLine();
                ImGui::TextDisabled("it is of another view");
            }
        }
    }
    if (facts.quality) numbers(*facts.quality, facts.quality_is_old);
    ImGui::Spacing();
    ImGui::TextWrapped("%s", facts.points.occasion().empty() ? "Time against error: nothing was measured yet."
                                                             : facts.points.occasion().c_str());
    scatter_plot(facts.points, 300);
    if (!facts.points.all().empty() &&
        ImGui::BeginTable("points", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("settings", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("ms");
        ImGui::TableSetupColumn("RMSE");
        ImGui::TableHeadersRow();
        for (const Point& p : facts.points.all()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(p.label.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f", p.ms);
            ImGui::TableNextColumn();
            ImGui::Text("%.3g", p.error);
        }
        ImGui::EndTable();
    }
}

}  // namespace pellucid::samples::viewer
