// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a scene needs, and why: it culls passes, sizes targets and sets specialisation constant 0 of every shader.
#include <pellucid/gpu/fragment_lists.h>
#include <pellucid/gpu/scene.h>
#include <pellucid/gpu/shadow_map.h>
#include <pellucid/renderer/settings.hpp>
#include <pellucid/scene/scene.hpp>
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1 {

/// What is built for a scene with some settings, and the reasons.
struct SceneNeeds {
    std::uint32_t mask = 0;                              ///< PELLUCID_NEED_* of gpu/scene.h
    std::uint32_t lights = 0;                            ///< that shine, the default sun among them
    std::uint32_t placed = 0;                            ///< of them, point and spot lights
    std::uint32_t ranged = 0;                            ///< of those, with a range
    LightAssignment assignment = LightAssignment::loop;  ///< of placed lights; never automatic
    std::string assignment_why;                          ///< why, where it is not the one that was asked for
    bool albedo_table = false;                           ///< image-based light or the conserving model looks it up
    LightGrid grid;                                      ///< of tiled and clustered; empty for others
    Shadows shadows = Shadows::none;                     ///< `map` where some light has a shadow map
    std::string shadows_why;                             ///< why, where it is not what was asked for
    std::uint32_t shadow_lights = 0;                     ///< with shadow maps
    std::uint32_t shadow_maps = 0;                       ///< of all of them: layers of the array
    bool opaque = false;           ///< any opaque or masked instance, or translucent ones are lit as they are
    bool lighting = false;         ///< a G-buffer and a lighting pass: light falls on them, or the G-buffer is kept
    bool translucent = false;      ///< any blended instance that is to be drawn
    bool emissive_target = false;  ///< the G-buffer stores emitted radiance
    [[nodiscard]] bool has(std::uint32_t bits) const noexcept { return (mask & bits) != 0; }
};

/// The sun of a scene without lights: 3 lx from over the right shoulder of a viewer who looks along -z.
[[nodiscard]] inline Light default_sun() {
    return {.kind = LightKind::directional,
            .color = {1, 1, 1},
            .intensity = 3,
            .direction = glm::normalize(glm::dvec3(-0.5, -1.0, -0.6)),
            .name = "default sun"};
}
/// [cd/m²] the constant ambient of a scene without lights.
inline constexpr float default_ambient = 0.25f;

/// Whether a scene without lights gets the default sun: not under a picture, which has a sun of its own.
[[nodiscard]] inline bool gets_default_sun(const Scene& scene, const RenderSettings& settings) {
    return scene.lights.empty() && settings.default_light && settings.environment.kind != EnvironmentKind::picture;
}

/// That a device can run a method of transparency.  Error: `unsupported`: what the method needs, what there is.
[[nodiscard]] inline Result<void> check_device(Transparency method, const rhi::DeviceInfo& device) {
    const auto refuse = [&](const std::string& needs, const std::string& has) -> Error {
        return {Errc::unsupported, std::string("the method '") + name(method) + "' needs " + needs + ", and " +
                                       device.name + " (" + device.backend + ") " + has +
                                       ": choose another method or another device"};
    };
    constexpr std::uint32_t side = 1u << PELLUCID_LISTS_WIDTH_BITS;
    if (traits(method).memory_budget && device.max_texture_size < side)  // it stores fragments
        return refuse("textures of " + std::to_string(side) + " texels a side",
                      "has at most " + std::to_string(device.max_texture_size));
    if (traits(method).float32_blending && !device.float32_blending)
        return refuse("blending into 32-bit float targets", "has none");
    return {};
}

/// Half angle [rad] of the widest spot whose shadow is one map; wider ones have six, as point lights do.
inline constexpr double widest_shadow_spot = 1.05;

/// Shadow maps that a light takes at most.
[[nodiscard]] inline std::uint32_t shadow_maps_of(const Light& light) {
    if (!light.shadows) return 0;
    if (light.kind == LightKind::directional) return PELLUCID_SHADOW_CASCADES;
    return light.kind == LightKind::spot && light.outer_cone <= widest_shadow_spot ? 1u : PELLUCID_SHADOW_FACES;
}

/// That a device can hold the shadow maps, before anything is allocated.  Errors: `invalid_argument` for a size out of
/// range or more bytes than `max_shadow_bytes`; `unsupported` for more maps than the device has layers.
[[nodiscard]] inline Result<void> check_shadows(const SceneNeeds& needs, const RenderSettings& settings,
                                                const rhi::DeviceInfo& device) {
    if (settings.shadows == Shadows::none) return {};
    const std::uint32_t side = settings.shadow_size;
    if (side < PELLUCID_SHADOW_MIN_SIZE || side > device.max_texture_size)
        return Error{Errc::invalid_argument, "a shadow map's size is " + std::to_string(side) + "; each side must be " +
                                                 std::to_string(PELLUCID_SHADOW_MIN_SIZE) + " to " +
                                                 std::to_string(device.max_texture_size) + " texels on " + device.name};
    const std::uint64_t bytes = std::uint64_t{4} * side * side * needs.shadow_maps;
    const std::string what = "the shadows of " + std::to_string(needs.shadow_lights) + " lights take " +
                             std::to_string(needs.shadow_maps) + " maps of " + std::to_string(side) + "x" +
                             std::to_string(side) + " texels, " + std::to_string(bytes) + " bytes; ";
    constexpr const char* mend = "let fewer lights cast (Light::shadows)";
    if (needs.shadow_maps > device.max_array_layers)
        return Error{Errc::unsupported, what + device.name + " has room for " +
                                            std::to_string(device.max_array_layers) + " maps in an array: " + mend};
    if (bytes > max_shadow_bytes)
        return Error{Errc::invalid_argument, what + "the limit is " + std::to_string(max_shadow_bytes) +
                                                 " bytes: ask for a smaller --shadow-size, or " + mend};
    return {};
}

/// Up to so many lights with a place a loop over all of them costs less than lists of them (benchmarks/light_lists).
inline constexpr std::uint32_t max_looped_lights = 8;

namespace detail {

/// Settles how lights find pixels, once all else is known.
inline void assign_lights(SceneNeeds& needs, const RenderSettings& settings, std::uint32_t lit_kinds) {
    using enum LightAssignment;
    needs.assignment = settings.lighting;
    const auto choose = [&](LightAssignment a, std::string why) {
        needs.assignment = a;
        needs.assignment_why = std::move(why);
    };
    const std::string count = std::to_string(needs.placed) + " point and spot lights";
    if (settings.lighting == automatic) {
        if (needs.placed <= max_looped_lights)
            choose(loop, count + "; up to " + std::to_string(max_looped_lights) + " a loop costs least");
        else
            choose(clustered, count + "; from " + std::to_string(max_looped_lights + 1) + " on lists cost least");
    }
    if (needs.assignment == volumes && (needs.ranged == 0 || !needs.lighting))
        choose(loop, needs.lighting ? "no light has a range" : "no light falls on an opaque surface");
    needs.grid = LightGrid::of(needs.assignment, settings.size, needs.placed, lit_kinds);
    if ((needs.assignment == tiled || needs.assignment == clustered) && needs.grid.empty())
        choose(loop, needs.placed == 0 ? "there are no point or spot lights" : "no light falls on any surface");
    needs.mask |= needs.assignment == tiled       ? PELLUCID_NEED_LIGHT_TILES
                  : needs.assignment == clustered ? PELLUCID_NEED_LIGHT_CLUSTERS
                  : needs.assignment == volumes   ? PELLUCID_NEED_LIGHT_VOLUMES
                                                  : 0u;
    if (needs.grid.empty() && needs.lights > 0 && needs.lights <= PELLUCID_LIGHT_BLOCK)
        needs.mask |= PELLUCID_NEED_LIGHT_BLOCK;
}

/// Settles which lights have shadow maps, once all else is known.
inline void assign_shadows(SceneNeeds& needs, const Scene& scene, const RenderSettings& settings, bool casters,
                           bool receivers) {
    if (settings.shadows == Shadows::none) return;
    const auto count = [&](const Light& light) {
        const std::uint32_t maps = shadow_maps_of(light);
        needs.shadow_lights += maps == 0 ? 0 : 1;
        needs.shadow_maps += maps;
    };
    for (const Light& light : scene.lights) count(light);
    if (scene.lights.empty() && settings.default_light) count(default_sun());
    needs.shadows_why = needs.shadow_lights == 0 ? "no light casts shadows"
                        : !receivers             ? "no light falls on any surface"
                        : !casters               ? "no opaque surface casts a shadow"
                                                 : "";
    if (needs.shadows_why.empty()) {
        needs.shadows = Shadows::map;
        needs.mask |= PELLUCID_NEED_SHADOWS;
    } else {
        needs.shadow_lights = needs.shadow_maps = 0;
    }
}

}  // namespace detail

/// What drawing `scene` with `settings` takes.
[[nodiscard]] inline SceneNeeds scene_needs(const Scene& scene, const RenderSettings& settings) {
    SceneNeeds needs;
    auto mark = [&](std::uint32_t bit, bool condition) { needs.mask |= condition ? bit : 0u; };
    bool lit = false, lit_opaque = false, lit_translucent = false, casters = false;
    bool deferred = false;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Material& m = scene.materials[mesh.material];
        const bool blend = m.alpha_mode == AlphaMode::blend;
        if (blend && settings.transparency == Transparency::none) continue;
        (blend ? needs.translucent : needs.opaque) = true;
        deferred = deferred || (blend && lit_with_opaque(settings.transparency));
        const bool emits = m.emissive != glm::vec3(0) || m.unlit;
        const bool in_gbuffer = !blend || settings.transparency == Transparency::interleaved_skyx;
        needs.emissive_target = needs.emissive_target || (emits && in_gbuffer);
        mark(PELLUCID_NEED_EMISSIVE, emits);
        mark(PELLUCID_NEED_UNLIT, m.unlit);
        casters = casters || (!blend && !mesh.indices.empty());
        lit = lit || !m.unlit;
        lit_opaque = lit_opaque || !(m.unlit || blend);
        lit_translucent = lit_translucent || (blend && !m.unlit);
        mark(PELLUCID_NEED_ALPHA_MASK, m.alpha_mode == AlphaMode::mask);
        mark(PELLUCID_NEED_NORMAL_MAPS, m.normal_texture.used() && !m.unlit);
        mark(PELLUCID_NEED_OCCLUSION, m.occlusion_texture.used());
        mark(PELLUCID_NEED_VERTEX_COLORS, !mesh.colors.empty());
        for (const TextureRef* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                      &m.occlusion_texture, &m.emissive_texture}) {
            mark(PELLUCID_NEED_TEXTURES, ref->used());
            mark(PELLUCID_NEED_SECOND_UV, ref->used() && ref->uv_set == 1);
        }
    }
    needs.opaque = needs.opaque || deferred;
    for (const Light& light : scene.lights) {
        mark(PELLUCID_NEED_DIRECTIONAL, light.kind == LightKind::directional);
        mark(PELLUCID_NEED_POINTS, light.kind == LightKind::point);
        mark(PELLUCID_NEED_SPOTS, light.kind == LightKind::spot);
        needs.placed += light.kind == LightKind::directional ? 0 : 1;
        needs.ranged += light.kind != LightKind::directional && reaches_an_end(light) ? 1 : 0;
    }
    mark(PELLUCID_NEED_LIGHT_RANGES, needs.ranged > 0);
    needs.lights = static_cast<std::uint32_t>(scene.lights.size());
    const EnvironmentKind environment = settings.environment.kind;
    if (gets_default_sun(scene, settings)) {
        mark(PELLUCID_NEED_DIRECTIONAL, true);
        mark(PELLUCID_NEED_AMBIENT, environment == EnvironmentKind::none);
        needs.lights = 1;
    }
    mark(PELLUCID_NEED_SKY, environment == EnvironmentKind::sky);
    mark(PELLUCID_NEED_ENVIRONMENT, environment == EnvironmentKind::picture);
    constexpr std::uint32_t around = PELLUCID_NEED_SKY | PELLUCID_NEED_ENVIRONMENT;
    mark(PELLUCID_NEED_BACKDROP, needs.has(around) && settings.environment.backdrop);
    constexpr std::uint32_t lights = PELLUCID_NEED_DIRECTIONAL | PELLUCID_NEED_POINTS | PELLUCID_NEED_SPOTS;
    const bool shines = needs.has(lights | PELLUCID_NEED_AMBIENT | around);
    // The lighting pass draws the environment behind everything, too.
    needs.opaque = needs.opaque || needs.has(PELLUCID_NEED_BACKDROP);
    needs.lighting = needs.opaque &&
                     ((lit_opaque && shines) || deferred || settings.keep_gbuffer || needs.has(PELLUCID_NEED_BACKDROP));
    mark(PELLUCID_NEED_NORMALS, (lit && needs.has(lights | around)) || (needs.opaque && settings.keep_gbuffer));
    if (settings.every_need) {
        needs.mask = PELLUCID_NEED_ALL | (needs.mask & (around | PELLUCID_NEED_BACKDROP));
        needs.emissive_target = true;
        needs.opaque = true;
        needs.lighting = true;
        needs.translucent = settings.transparency != Transparency::none;
    }
    needs.albedo_table = needs.has(PELLUCID_NEED_NORMALS) &&
                         (needs.has(around) || (settings.brdf == Brdf::conserving && needs.has(lights)));
    detail::assign_lights(
        needs, settings,
        (needs.lighting ? PELLUCID_LIGHTS_OPAQUE : 0u) |
            (needs.translucent && (lit_translucent || settings.every_need) ? PELLUCID_LIGHTS_TRANSLUCENT : 0u));
    detail::assign_shadows(needs, scene, settings, casters, lit);
    return needs;
}

}  // namespace pellucid::inline v0_1
