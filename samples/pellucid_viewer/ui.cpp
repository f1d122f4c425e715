// SPDX-License-Identifier: MIT
#include "ui.hpp"
#include <imgui.h>
#include <algorithm>

namespace pellucid::samples::viewer {

Ui::Ui() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // the layout is the program's
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0;
    style.FrameRounding = 2;
    style.WindowBorderSize = 0;
    style.ItemSpacing = {6, 4};
    style.Colors[ImGuiCol_WindowBg] = {0.08f, 0.08f, 0.09f, 1.0f};
}
Ui::~Ui() {
    ImGui::DestroyContext(context_);
}

ImFontAtlas& Ui::fonts() const {
    ImGui::SetCurrentContext(context_);
    return *ImGui::GetIO().Fonts;
}

void Ui::begin(const Input& input, Extent2D canvas) const {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(canvas.width), static_cast<float>(canvas.height)};
    io.DeltaTime = static_cast<float>(std::max(input.seconds, 1e-4));
    const bool buttons[] = {input.left, input.right, input.middle};
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(input.x, input.y);
    for (int i = 0; i < 3; ++i) io.AddMouseButtonEvent(i, buttons[i]);
    if (input.wheel != 0) io.AddMouseWheelEvent(0, input.wheel);
#else
    io.MousePos = {input.x, input.y};
    for (int i = 0; i < 3; ++i) io.MouseDown[i] = buttons[i];
    io.MouseWheel += input.wheel;
#endif
    ImGui::NewFrame();
}

const ImDrawData& Ui::end() const {
    ImGui::Render();
    return *ImGui::GetDrawData();
}

bool Ui::wants_pointer() const {
    return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace pellucid::samples::viewer
