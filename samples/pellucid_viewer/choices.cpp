// SPDX-License-Identifier: MIT
#include "choices.hpp"
#include <cstdio>
#include <tuple>

namespace pellucid::samples::viewer {
namespace {

/// Every member: a new one does not compile until it is here.
auto members(const Environment& e) {
    const auto& [kind, sky, picture, size, backdrop] = e;
    const auto& [horizon, zenith, nadir] = sky;
    return std::tuple(kind, horizon, zenith, nadir, picture, size, backdrop);
}
auto members(const RenderSettings& s) {
    const auto& [size, transparency, gbuffer, shading, lighting, shadows, shadow_size, brdf, tonemap, exposure_ev,
                 background, environment, default_light, max_layers, seed_composite, skyx_alpha_gain, min_transmittance,
                 memory_budget, audit, exact, keep_gbuffer, every_need] = s;
    return std::tuple(size, transparency, gbuffer, shading, lighting, shadows, shadow_size, brdf, tonemap, exposure_ev,
                      background, members(environment), default_light, max_layers, seed_composite, skyx_alpha_gain,
                      min_transmittance, memory_budget, audit, exact, keep_gbuffer, every_need);
}

}  // namespace

bool same(const RenderSettings& a, const RenderSettings& b) {
    return members(a) == members(b);
}

std::string describe(const RenderSettings& s) {
    const RenderSettings usual;
    std::string text = name(s.transparency);
    const auto add = [&](bool differs, const std::string& what) {
        if (differs) text += ", " + what;
    };
    char number[32];
    std::snprintf(number, sizeof number, "T %g", static_cast<double>(s.min_transmittance));
    add(s.max_layers != 0, std::to_string(s.max_layers) + " layers");
    add(s.memory_budget != 0, std::to_string(s.memory_budget >> 20u) + " MiB");
    add(s.min_transmittance > 0, number);
    add(s.seed_composite, "seed composite");
    add(s.skyx_alpha_gain, "alpha gain");
    add(s.gbuffer != usual.gbuffer, name(s.gbuffer));
    add(s.shading != usual.shading, name(s.shading));
    add(s.lighting != usual.lighting, name(s.lighting));
    add(s.shadows != usual.shadows, "shadows " + std::to_string(s.shadow_size));
    add(s.exact, "exact arithmetic");
    return text;
}

RenderSettings with_method(RenderSettings settings, Transparency method) {
    const TransparencyTraits& t = traits(method);
    settings.transparency = method;
    if (!t.layers) settings.max_layers = 0;
    if (!t.min_transmittance) settings.min_transmittance = 0;
    if (!t.memory_budget) settings.memory_budget = 0;
    if (!t.audit) settings.audit = false;
    if (!t.seed_composite) settings.seed_composite = false;
    if (!t.skyx_alpha_gain) settings.skyx_alpha_gain = false;
    return settings;
}

}  // namespace pellucid::samples::viewer
