// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// A scene of any number of small lights: what light assignment is tested and measured on.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/scene.hpp>
#include <cstdint>

namespace pellucid::inline v0_1 {

/// A field of small lights over a floor with pillars.
struct LightField {
    std::uint32_t lights = 1000;  ///< every fourth is a spot that points down, the others are point lights
    double overlap = 4;           ///< lights over a point of the floor, on average, however many there are
    bool panes = true;            ///< translucent panes between the pillars
    std::uint32_t seed = 1;
};

/// A floor of 40 × 40 m with 8 × 8 pillars and spheres, lit by lights of one range [m], √(overlap · 1600/(π lights)),
/// 0.35 ranges above the floor; each is as bright on the floor below it whatever its range.  The same arguments give
/// the same scene.
[[nodiscard]] Scene make_light_field(const LightField& field = {});

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/light_field-inl.hpp>
#endif
