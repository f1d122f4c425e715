// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Punctual lights as KHR_lights_punctual means them, and the radiance of a surface under a list of them, in double.
///
/// Shadows are for whoever calls to say.  Radiance = Σ f(V,L)(N·L) E + ambient + environment + emissive [cd/m²], with
/// E the illuminance of a light at normal incidence [lx] times its linear colour:
///   directional E = intensity;   point E = intensity · falloff(d);   spot E = point's E · cone².
#include <algorithm>
#include <cmath>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/image_based_light.hpp>
#include <pellucid/scene/camera.hpp>
#include <pellucid/scene/light.hpp>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// A light is never nearer than this to what it lights [m]: 1/d² stops growing, so that a light on a surface stays
/// finite.  At d = 1 mm and beyond 1/d² is exact.
inline constexpr double min_light_distance = 1e-3;

/// Smallest difference of the cosines of a spot's half angles; equal angles become a hard edge.
inline constexpr double min_cone_difference = 1e-12;

/// max(min(1 − (d/range)⁴, 1), 0)/d² [1/m²], the extension's window, not squared.  `range` <= 0 or infinite: no window.
/// Exactly 0 from d = range on.  `distance` >= 0 [m]; d = 0 is finite (`min_light_distance`).
[[nodiscard]] inline double distance_falloff(double distance, double range) noexcept;

/// A spot's cone prepared once: the factor is clamp((outer − (1 − cos θ)) scale, 0, 1)², which is the extension's
/// clamp(cos θ lightAngleScale + lightAngleOffset, 0, 1)² written with 1 − cos, which keeps its digits in narrow cones.
struct SpotCone {
    double outer = 0;  ///< 1 − cos(outer half angle) = 2 sin²(outer/2)
    double scale = 0;  ///< 1/(cos inner − cos outer), the difference being 2 sin((o+i)/2) sin((o−i)/2)
};

/// Half angles in radians, 0 <= inner <= outer <= π/2.  The difference of cosines is limited to 1e-12 (the extension's
/// sample code limits it to 0.001, which dims every spot narrower than 2.6°, by 37 % at 2°).
[[nodiscard]] inline SpotCone spot_cone(double inner, double outer) noexcept;

/// The cone's factor in [0,1].  Both vectors are unit; `direction` is the way the light travels.
/// 1 − cos θ = |direction + to_light|²/2, θ between the spot's axis and the ray from the light.
[[nodiscard]] inline double spot_factor(const SpotCone& cone, glm::dvec3 direction, glm::dvec3 to_light) noexcept;

/// What arrives from one light.
struct LightSample {
    glm::dvec3 to_light{0, 0, 0};     ///< unit; (0,0,0) where nothing arrives
    glm::dvec3 illuminance{0, 0, 0};  ///< [lx] at normal incidence, times the light's colour
};

/// `lights` with positions and directions in the view space of `camera`.
[[nodiscard]] inline std::vector<Light> lights_in_view(std::vector<Light> lights, const Camera& camera);

/// The light at `position` [m, world].  A point or spot light exactly at `position` has no direction and gives nothing.
[[nodiscard]] inline LightSample sample_light(const Light& light, glm::dvec3 position) noexcept;

/// Unit vector from `position` [m, world] to the eye; for an orthographic camera, or at the eye itself, the view's
/// backward axis.
[[nodiscard]] inline glm::dvec3 direction_to_eye(const Camera& camera, glm::dvec3 position) noexcept;

/// Radiance [cd/m²] towards `to_eye` (unit) of a surface at `position` [m, world].  Ambient light is the same radiance
/// from everywhere, and a surface returns `ambient · base_color · occlusion` of it: a perfect diffuser for dielectrics,
/// F0 for metals.  Lights are added in the order of the list, then what `environment` makes (image_based_light.hpp),
/// dimmed by occlusion like ambient light; null: none.
[[nodiscard]] inline glm::dvec3 surface_radiance(const Surface<double>& surface, glm::dvec3 position, glm::dvec3 to_eye,
                                                 std::span<const Light> lights, glm::dvec3 ambient,
                                                 BrdfModel model = BrdfModel::gltf,
                                                 const EnvironmentLight* environment = nullptr);

/// The same of the lights that get there: `visible(light, to_light)` says so of one that lights the surface.
template <class Visible>
[[nodiscard]] glm::dvec3 surface_radiance(const Surface<double>& surface, glm::dvec3 position, glm::dvec3 to_eye,
                                          std::span<const Light> lights, glm::dvec3 ambient, BrdfModel model,
                                          Visible&& visible, const EnvironmentLight* environment) {
    glm::dvec3 radiance = surface.emissive + ambient * surface.base_color * surface.occlusion;
    for (const Light& light : lights) {
        const LightSample sample = sample_light(light, position);
        const glm::dvec3 added = evaluate_brdf(model, surface, to_eye, sample.to_light).total() * sample.illuminance;
        if (added != glm::dvec3(0) && visible(light, sample.to_light)) radiance += added;
    }
    if (environment) radiance += environment_response(surface, to_eye, *environment, model) * surface.occlusion;
    return radiance;
}

// ---------------------------------------------------------------------------------------------------- bodies

inline std::vector<Light> lights_in_view(std::vector<Light> lights, const Camera& camera) {
    const glm::dmat4 view_from_world = rigid_inverse(camera.world_from_view);
    for (Light& light : lights) {
        light.position = glm::dvec3(view_from_world * glm::dvec4(light.position, 1));
        light.direction = glm::dvec3(view_from_world * glm::dvec4(light.direction, 0));
    }
    return lights;
}

double distance_falloff(double distance, double range) noexcept {
    const double nearest = std::max(distance, min_light_distance);
    const double falloff = 1.0 / (nearest * nearest);
    if (!(range > 0)) return falloff;
    const double ratio = distance / range;
    const double ratio2 = ratio * ratio;
    return std::max(std::min(1.0 - ratio2 * ratio2, 1.0), 0.0) * falloff;
}

SpotCone spot_cone(double inner, double outer) noexcept {
    const double half_sine = std::sin(0.5 * outer);
    const double difference = 2.0 * std::sin(0.5 * (outer + inner)) * std::sin(0.5 * (outer - inner));
    return {2.0 * half_sine * half_sine, 1.0 / std::max(difference, min_cone_difference)};
}

double spot_factor(const SpotCone& cone, glm::dvec3 direction, glm::dvec3 to_light) noexcept {
    const glm::dvec3 off_axis = direction + to_light;
    const double factor = std::clamp((cone.outer - 0.5 * glm::dot(off_axis, off_axis)) * cone.scale, 0.0, 1.0);
    return factor * factor;
}

LightSample sample_light(const Light& light, glm::dvec3 position) noexcept {
    const glm::dvec3 power = glm::dvec3(light.color) * static_cast<double>(light.intensity);
    if (light.kind == LightKind::directional) return {-light.direction, power};
    const glm::dvec3 offset = light.position - position;
    const double distance = glm::length(offset);
    if (!(distance > 0)) return {};
    const glm::dvec3 to_light = offset / distance;
    double factor = distance_falloff(distance, light.range);
    if (light.kind == LightKind::spot)
        factor *= spot_factor(spot_cone(light.inner_cone, light.outer_cone), light.direction, to_light);
    return {to_light, power * factor};
}

glm::dvec3 direction_to_eye(const Camera& camera, glm::dvec3 position) noexcept {
    const glm::dvec3 back(camera.world_from_view[2]);
    if (camera.projection == Projection::orthographic) return back;
    const glm::dvec3 offset = glm::dvec3(camera.world_from_view[3]) - position;
    const double distance = glm::length(offset);
    return distance > 0 ? offset / distance : back;
}

glm::dvec3 surface_radiance(const Surface<double>& surface, glm::dvec3 position, glm::dvec3 to_eye,
                            std::span<const Light> lights, glm::dvec3 ambient, BrdfModel model,
                            const EnvironmentLight* environment) {
    return surface_radiance(
        surface, position, to_eye, lights, ambient, model, [](const Light&, const glm::dvec3&) { return true; },
        environment);
}

}  // namespace pellucid::inline v0_1::reference
