// SPDX-License-Identifier: MIT
#include "panel_parts.hpp"
#include "widgets.hpp"

namespace pellucid::samples::viewer {
namespace {

void camera(const Facts& facts, Choices& choices, Requests& requests) {
    const std::string& current = facts.cameras.empty() ? facts.scene : facts.cameras[facts.camera];
    if (ImGui::BeginCombo("camera", current.c_str())) {
        for (std::size_t i = 0; i < facts.cameras.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(facts.cameras[i].c_str(), i == facts.camera)) requests.camera = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    for (std::size_t i = 0; i < std::size(motion_names); ++i) {
        if (ImGui::RadioButton(motion_names[i], choices.motion == static_cast<Motion>(i)))
            choices.motion = static_cast<Motion>(i);
        ImGui::SameLine();
    }
    if (ImGui::SmallButton("back to its place")) requests.camera = facts.camera;
    hint(
        "orbit: left button turns, right or middle button moves, wheel comes closer\nwalk: W A S D, Q and E, any "
        "button "
        "looks round, wheel changes the speed");
}

void method(const Facts& facts, RenderSettings& s) {
    Transparency chosen = s.transparency;
    const auto why_not = [&](Transparency t) {
        const auto at = static_cast<std::size_t>(t);
        return at < facts.unavailable.size() ? facts.unavailable[at] : std::string();
    };
    if (choose("transparency", chosen, std::end(all_transparencies)[-1].method, why_not)) s = with_method(s, chosen);
    const TransparencyTraits& t = traits(s.transparency);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    if (*t.loses == 0)
        ImGui::TextWrapped("exact");
    else
        ImGui::TextWrapped("may lose %s", t.loses);
    ImGui::PopStyleColor();

    const auto heeded = [&](bool heeds, auto&& widget, const char* what) {
        ImGui::BeginDisabled(!heeds);
        widget();
        ImGui::EndDisabled();
        hint(heeds ? what : (std::string(t.name) + " does not heed it: " + what).c_str());
    };
    heeded(
        t.layers, [&] { slide("layers", s.max_layers, 0, 64, s.max_layers == 0 ? "all" : "%.0f"); },
        "at most so many layers; 0: all there are (peel-seed: 6)");
    heeded(
        t.min_transmittance,
        [&] { slide("min transmittance", s.min_transmittance, 0, 0.5f, "%.4f", ImGuiSliderFlags_Logarithmic); },
        "a pixel ends where no more than this share of the light gets through");
    auto mib = static_cast<std::uint32_t>(s.memory_budget >> 20u);
    heeded(
        t.memory_budget,
        [&] {
            if (slide("memory budget", mib, 0, 1024, mib == 0 ? "what can be bound" : "%.0f MiB"))
                s.memory_budget = std::uint64_t{mib} << 20u;
        },
        "of stored fragments; rows are drawn in bands where it is too small for all");
    heeded(
        t.seed_composite, [&] { ImGui::Checkbox("seed composite", &s.seed_composite); },
        "composite with the factors that the document of peel-seed has by mistake");
    ImGui::SameLine();
    heeded(
        t.skyx_alpha_gain, [&] { ImGui::Checkbox("alpha gain", &s.skyx_alpha_gain); },
        "alpha of the picture grows by 1.1 a layer, as it once did");
}

void comparison(const Facts& facts, Choices& choices) {
    constexpr const char* names[] = {"nothing", "another method", "the reference"};
    if (ImGui::BeginCombo("against", names[static_cast<std::size_t>(choices.against)])) {
        for (std::size_t i = 0; i < std::size(names); ++i)
            if (ImGui::Selectable(names[i], choices.against == static_cast<Against>(i)))
                choices.against = static_cast<Against>(i);
        ImGui::EndCombo();
    }
    if (choices.against == Against::method)
        choose("right method", choices.other, std::end(all_transparencies)[-1].method, [&](Transparency t) {
            const auto at = static_cast<std::size_t>(t);
            return at < facts.unavailable.size() ? facts.unavailable[at] : std::string();
        });
    if (choices.against == Against::reference) {
        for (const std::uint32_t divisor : {1u, 2u, 4u}) {
            const std::string label = divisor == 1 ? "full size" : "1/" + std::to_string(divisor);
            if (ImGui::RadioButton(label.c_str(), choices.reference_divisor == divisor))
                choices.reference_divisor = divisor;
            ImGui::SameLine();
        }
        ImGui::TextDisabled("of the reference");
    }
    ImGui::BeginDisabled(choices.against == Against::nothing);
    ImGui::SliderFloat("split", &choices.split, 0, 1, "%.2f");
    ImGui::EndDisabled();
    choose("view", choices.view, View::overdraw);
}

void light(RenderSettings& s) {
    choose("lights", s.lighting, LightAssignment::clustered);
    choose("shading", s.shading, ShadingStage::fragment);
    choose("G-buffer", s.gbuffer, GBufferLayout::classic);
    choose("BRDF", s.brdf, Brdf::conserving);
    choose("shadows", s.shadows, Shadows::map);
    ImGui::BeginDisabled(s.shadows == Shadows::none);
    if (ImGui::BeginCombo("shadow maps", std::to_string(s.shadow_size).c_str())) {
        for (std::uint32_t side = 256; side <= 4096; side *= 2)
            if (ImGui::Selectable(std::to_string(side).c_str(), side == s.shadow_size)) s.shadow_size = side;
        ImGui::EndCombo();
    }
    ImGui::EndDisabled();
    Environment& e = s.environment;
    choose("environment", e.kind, EnvironmentKind::picture, [&](EnvironmentKind kind) {
        return std::string(kind == EnvironmentKind::picture && !e.picture
                               ? "there is no picture: start with --environment FILE.hdr, or drop a file"
                               : "");
    });
    ImGui::BeginDisabled(e.kind == EnvironmentKind::none);
    ImGui::Checkbox("seen behind", &e.backdrop);
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::Checkbox("default sun", &s.default_light);
    hint("a scene without lights gets one sun and a constant ambient");
    ImGui::SameLine();
    ImGui::Checkbox("exact bits", &s.exact);
    hint("lighting arithmetic that gives the same bits on every API, about 10 % slower");
}

void display(RenderSettings& s) {
    choose("tone map", s.tonemap, ToneCurve::agx);
    slide("exposure", s.exposure_ev, -8, 8, "%.1f EV");
    ImGui::ColorEdit3("background", &s.background.x,
                      ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_HDR);
}

}  // namespace

void settings_tab(const Facts& facts, Choices& choices, Requests& requests) {
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.62f);
    ImGui::Text("%s", facts.scene.c_str());
    camera(facts, choices, requests);
    ImGui::Separator();
    method(facts, choices.render);
    ImGui::Separator();
    comparison(facts, choices);
    ImGui::Separator();
    light(choices.render);
    ImGui::Separator();
    display(choices.render);
    ImGui::PopItemWidth();
}

}  // namespace pellucid::samples::viewer
