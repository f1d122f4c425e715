// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Small pieces that panels are made of.
#include <imgui.h>
#include <cstdint>
#include <cstdio>
#include <string>

namespace pellucid::samples::viewer {

[[nodiscard]] inline std::string bytes_text(std::uint64_t bytes) {
    char text[32];
    if (bytes >= 1u << 20u)
        std::snprintf(text, sizeof text, "%.1f MiB", static_cast<double>(bytes) / (1u << 20u));
    else
        std::snprintf(text, sizeof text, "%.1f KiB", static_cast<double>(bytes) / (1u << 10u));
    return text;
}

/// What an item that the pointer is over means; on disabled ones too.
inline void hint(const char* text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(380);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// One of the enumerators 0 … `last`, by their names.  `why_not(value)`: empty, or why it cannot be chosen.
template <class E, class WhyNot>
bool choose(const char* label, E& value, E last, WhyNot why_not) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, name(value))) return false;
    for (int i = 0; i <= static_cast<int>(last); ++i) {
        const E item = static_cast<E>(i);
        const std::string reason = why_not(item);
        if (ImGui::Selectable(name(item), item == value,
                              reason.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled) &&
            item != value) {
            value = item;
            changed = true;
        }
        if (!reason.empty()) hint(reason.c_str());
    }
    ImGui::EndCombo();
    return changed;
}
template <class E>
bool choose(const char* label, E& value, E last) {
    return choose(label, value, last, [](E) { return std::string(); });
}

/// A slider whose value counts when the pointer lets go of it: each value builds a renderer.
inline bool slide(const char* label, float& value, float low, float high, const char* format,
                  ImGuiSliderFlags flags = 0) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(label);
    float shown = storage.GetBool(id) ? storage.GetFloat(id + 1) : value;
    ImGui::SliderFloat(label, &shown, low, high, format, flags);
    const bool done = ImGui::IsItemDeactivatedAfterEdit();
    storage.SetBool(id, ImGui::IsItemActive());
    storage.SetFloat(id + 1, shown);
    if (done) value = shown;
    return done;
}
inline bool slide(const char* label, std::uint32_t& value, std::uint32_t low, std::uint32_t high, const char* format) {
    float number = static_cast<float>(value);
    const bool done = slide(label, number, static_cast<float>(low), static_cast<float>(high), format);
    if (done) value = static_cast<std::uint32_t>(number + 0.5f);
    return done;
}

}  // namespace pellucid::samples::viewer
