// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which lights can take the place of others while everything that was built for those stays.
#include <pellucid/renderer/needs.hpp>
#include <pellucid/scene/light.hpp>
#include <string>

namespace pellucid::inline v0_1 {

/// That `light`, number `index` of the scene, can take the place of `had`: of the same kind, with a range where there
/// was one and, where shadow maps are drawn (`maps`), with as many of them.  Error: `invalid_argument`.
[[nodiscard]] inline Result<void> check_light_change(const Light& had, const Light& light, std::size_t index,
                                                     bool maps) {
    const auto fail = [&](const std::string& now, const std::string& before) -> Result<void> {
        return Error{Errc::invalid_argument, "light " + std::to_string(index) + " (\"" + light.name + "\") " + now +
                                                 ", and the renderer was built for one that " + before +
                                                 ": keep it so, or create a renderer for these lights"};
    };
    const auto kind = [](const Light& l) {
        constexpr const char* names[] = {"is directional", "is a point light", "is a spot light"};
        return std::string(names[static_cast<std::size_t>(l.kind)]);
    };
    const auto range = [](const Light& l) {
        return std::string(reaches_an_end(l) ? "ends at a range" : "has no range");
    };
    const auto shadows = [](const Light& l) {
        return l.shadows ? "casts shadows by " + std::to_string(shadow_maps_of(l)) +
                               (shadow_maps_of(l) == 1 ? " map" : " maps")
                         : std::string("casts no shadows");
    };
    if (had.kind != light.kind) return fail(kind(light), kind(had));
    if (light.kind != LightKind::directional && reaches_an_end(had) != reaches_an_end(light))
        return fail(range(light), range(had));
    if (maps && shadow_maps_of(had) != shadow_maps_of(light)) return fail(shadows(light), shadows(had));
    return {};
}

}  // namespace pellucid::inline v0_1
