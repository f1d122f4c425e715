// SPDX-License-Identifier: MIT
#include "panel_parts.hpp"
#include "widgets.hpp"
#include <algorithm>
#include <cmath>

namespace pellucid::samples::viewer {
namespace {

constexpr ImU32 paper = IM_COL32(0, 0, 0, 160), ink = IM_COL32(255, 255, 255, 255);

void tag(ImDrawList& list, float x, float y, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddRectFilled({x - 4, y - 2}, {x + size.x + 4, y + size.y + 2}, paper);
    list.AddText({x, y}, ink, text.c_str());
}

void split(ImDrawList& list, const Layout& layout, const Facts& facts, const Choices& choices) {
    const auto left = static_cast<float>(layout.picture.x), width = static_cast<float>(layout.picture.width);
    const float at = left + static_cast<float>(split_column(layout.picture.width, choices.split));
    if (at > left && at < left + width) {
        list.AddLine({at, 0}, {at, static_cast<float>(layout.picture.height)}, IM_COL32(0, 0, 0, 160), 3);
        list.AddLine({at, 0}, {at, static_cast<float>(layout.picture.height)}, ink, 1);
    }
    const std::string left_text =
        choices.view == View::picture ? facts.left.label : facts.left.label + ": " + name(choices.view);
    const float room = 12 + ImGui::CalcTextSize(left_text.c_str()).x;
    if (at - left > room) tag(list, at - room, 8, left_text);
    if (left + width - at > 12 + ImGui::CalcTextSize(facts.right.label.c_str()).x)
        tag(list, at + 12, 8, facts.right.label);
}

void legend(ImDrawList& list, const Layout& layout, const Legend& legend) {
    constexpr float bar = 300, thick = 14;
    const float x = static_cast<float>(layout.picture.x) + 16,
                y = static_cast<float>(layout.picture.height) - 16 - 2 * thick - 24;
    char text[160];
    std::snprintf(text, sizeof text, "%s (mean %.3g)", legend.what.c_str(), legend.mean);
    const float wide = std::max(bar + 28, ImGui::CalcTextSize(text).x);
    list.AddRectFilled({x - 8, y - 24}, {x + wide + 8, y + thick + 24}, paper);
    list.AddText({x, y - 20}, ink, text);
    for (int i = 0; i < static_cast<int>(bar); ++i) {
        const measure::Rgb8 c = measure::heat_color(i / static_cast<double>(bar - 1));
        list.AddRectFilled({x + static_cast<float>(i), y}, {x + static_cast<float>(i + 1), y + thick},
                           IM_COL32(c[0], c[1], c[2], 255));
    }
    for (int i = 0; i <= 4; ++i) {
        const double t = i / 4.0;
        const double value = legend.scale == measure::HeatScale::linear || !(legend.low > 0)
                                 ? legend.low + t * (legend.high - legend.low)
                                 : legend.low * std::pow(legend.high / legend.low, t);
        std::snprintf(text, sizeof text, "%.2g", value);
        list.AddText({x + static_cast<float>(t) * bar - (i == 0 ? 0.0f : 8.0f), y + thick + 4}, ink, text);
    }
}

void progress(const Layout& layout, const Facts& facts, Requests& requests) {
    const bool any = facts.loading || facts.reference || facts.judging || facts.measuring;
    if (!any) return;
    const float width = std::min(360.0f, static_cast<float>(layout.picture.width) - 16);
    ImGui::SetNextWindowPos({static_cast<float>(layout.canvas.width) - width - 8, 36});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowBgAlpha(0.8f);
    ImGui::Begin("progress", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    const auto bar = [](const std::optional<Progress>& p) {
        if (!p) return;
        ImGui::TextUnformatted(p->what.c_str());
        // Nobody knows how long: a bar that fills again and again.
        const double share = p->fraction >= 0 ? p->fraction : std::fmod(ImGui::GetTime(), 1.0);
        ImGui::ProgressBar(static_cast<float>(share), {-1, 0}, p->fraction >= 0 ? nullptr : "");
    };
    bar(facts.loading);
    bar(facts.reference);
    if (facts.reference && ImGui::SmallButton("cancel")) requests.cancel_reference = true;
    bar(facts.judging);
    bar(facts.measuring);
    ImGui::End();
}

}  // namespace

void overlay(const Layout& layout, const Facts& facts, const Choices& choices, Requests& requests) {
    if (choices.hide_ui || layout.picture.width < 64 || layout.picture.height < 64) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (choices.against != Against::nothing && facts.right.drawn) split(list, layout, facts, choices);
    if (!facts.legend.empty()) legend(list, layout, facts.legend);
    progress(layout, facts, requests);
}

}  // namespace pellucid::samples::viewer
