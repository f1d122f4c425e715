// SPDX-License-Identifier: MIT
#include "panel.hpp"
#include "panel_parts.hpp"
#include "widgets.hpp"
#include <cstdio>

namespace pellucid::samples::viewer {
namespace {

void message(const Facts& facts) {
    const auto say = [](const std::string& text, bool error) {
        if (text.empty()) return;
        ImGui::PushStyleColor(ImGuiCol_Text, error ? ImVec4{1.0f, 0.55f, 0.45f, 1} : ImVec4{0.65f, 0.85f, 0.65f, 1});
        ImGui::TextWrapped("%s", text.c_str());
        ImGui::PopStyleColor();
    };
    say(facts.left.problem, true);
    if (facts.right.problem != facts.left.problem) say(facts.right.problem, true);
    say(facts.message, facts.message_is_error);
}

void head(const Facts& facts, Requests& requests) {
    ImGui::Text("%s: %s", facts.device.backend.c_str(), facts.device.name.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\n%s", facts.device.driver.c_str(), facts.device.api.c_str());
    if (facts.history.wall.count() > 0)
        ImGui::TextDisabled("%u draws, %llu triangles, %s", facts.left.stats.draws,
                            static_cast<unsigned long long>(facts.left.stats.triangles),
                            bytes_text(facts.left.stats.bytes).c_str());
    for (const std::string& backend : facts.backends) {
        if (backend == facts.device.backend) continue;
        if (ImGui::SmallButton(("switch to " + backend).c_str())) requests.backend = backend;
        ImGui::SameLine();
    }
    if (ImGui::SmallButton("screenshot")) requests.screenshot_png = true;
    ImGui::SameLine();
    if (ImGui::SmallButton("picture.png")) requests.picture_png = true;
    ImGui::SameLine();
    if (ImGui::SmallButton("picture.exr")) requests.picture_exr = true;
}

}  // namespace

void draw_panel(const Layout& layout, const Facts& facts, Choices& choices, Requests& requests) {
    overlay(layout, facts, choices, requests);
    if (layout.panel == 0) return;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({static_cast<float>(layout.panel), static_cast<float>(layout.canvas.height)});
    ImGui::Begin("pellucid-viewer", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    head(facts, requests);
    message(facts);
    ImGui::Spacing();
    for (std::size_t i = 0; i < std::size(tab_names); ++i) {
        const bool chosen = choices.tab == static_cast<Tab>(i);
        if (i > 0) ImGui::SameLine();
        if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        const float width = (static_cast<float>(layout.panel) - 28) / static_cast<float>(std::size(tab_names));
        if (ImGui::Button(tab_names[i], {width, 0})) choices.tab = static_cast<Tab>(i);
        if (chosen) ImGui::PopStyleColor();
    }
    ImGui::Separator();
    ImGui::BeginChild("tab", {0, 0});
    switch (choices.tab) {
        case Tab::settings:
            settings_tab(facts, choices, requests);
            break;
        case Tab::time:
            time_tab(facts);
            break;
        case Tab::error:
            error_tab(facts, choices, requests);
            break;
    }
    ImGui::EndChild();
    ImGui::End();
}

}  // namespace pellucid::samples::viewer
