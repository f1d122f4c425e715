// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a user may ask of the renderer.  Every default is what a first picture wants.
#include <pellucid/core/image.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/passes/light_lists.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <pellucid/scene/environment.hpp>
#include <glm/vec3.hpp>
#include <cstdint>
#include <iterator>

namespace pellucid::inline v0_1 {

/// How translucent surfaces are drawn; `all_transparencies` says what each promises.
enum class Transparency : std::uint8_t {
    none,              ///< translucent surfaces are left out
    sorted,            ///< whole meshes drawn back to front: exact only where their depth ranges do not overlap
    peel,              ///< exact: depth peeling in two phases, by blending and depth tests alone
    peel_seed,         ///< six layers, as in the document the project grew from; kept to be measured
    dual_peel,         ///< dual depth peeling, the well-known peer: exact but for fragments of equal depth
    interleaved_skyx,  ///< one surface a pixel, opaque or not, united in windows of 2×2; kept to be measured
    interleaved,  ///< exact but for light: one translucent surface a pixel is lit, the others find theirs beside them
    abuffer       ///< exact: every fragment stored, sorted and composited in compute, in bands where memory is short
};

/// What a method promises, what it needs of a device, and which settings it heeds: in the order of the enumerators.
/// Every list of methods in a program, its help or a sentence is made from this one.
struct TransparencyTraits {
    Transparency method = Transparency::none;
    const char* name = "";
    const char* loses = "";          ///< what may be missing from its picture or out of place; empty: nothing
    bool float32_blending = false;   ///< needs a device that blends into 32-bit float targets
    bool layers = false;             ///< max_layers
    bool min_transmittance = false;  ///< min_transmittance
    bool memory_budget = false;      ///< memory_budget
    bool audit = false;              ///< audit
    bool seed_composite = false;     ///< seed_composite
    bool skyx_alpha_gain = false;    ///< skyx_alpha_gain
};
inline constexpr TransparencyTraits all_transparencies[] = {
    {.method = Transparency::none, .name = "none", .loses = "every translucent surface"},
    {.method = Transparency::sorted,
     .name = "sorted",
     .loses = "the order of surfaces that overlap each other, or themselves, in depth"},
    {.method = Transparency::peel,
     .name = "peel",
     .float32_blending = true,
     .layers = true,
     .min_transmittance = true,
     .audit = true},
    {.method = Transparency::peel_seed,
     .name = "peel-seed",
     .loses =
         "layers beyond their number, layers closer than 1e-4 in depth, all but one of equal depth, radiance above "
         "1, and what 8 bits cannot hold",
     .layers = true,
     .seed_composite = true},
    {.method = Transparency::dual_peel,
     .name = "dual-peel",
     .loses = "all but one of a pixel's fragments of equal depth",
     .float32_blending = true,
     .layers = true},
    {.method = Transparency::interleaved_skyx,
     .name = "interleaved-skyx",
     .loses =
         "opaque detail behind translucent surfaces, a pixel at silhouettes, all but one surface of an instance, all "
         "but three layers, and their order",
     .skyx_alpha_gain = true},
    {.method = Transparency::interleaved,
     .name = "interleaved",
     .loses = "light that changes within a pixel of a surface whose neighbours agree",
     .float32_blending = true,
     .min_transmittance = true,
     .memory_budget = true},
    {.method = Transparency::abuffer,
     .name = "abuffer",
     .float32_blending = true,
     .min_transmittance = true,
     .memory_budget = true,
     .audit = true}};
static_assert(
    [] {
        for (std::size_t i = 0; i < std::size(all_transparencies); ++i)
            if (all_transparencies[i].method != static_cast<Transparency>(i)) return false;
        return true;
    }(),
    "all_transparencies is in the order of the enumerators");

/// What a method promises and heeds.
[[nodiscard]] constexpr const TransparencyTraits& traits(Transparency t) noexcept {
    return all_transparencies[static_cast<std::size_t>(t)];
}
/// As programs spell it.
[[nodiscard]] constexpr const char* name(Transparency t) noexcept {
    return traits(t).name;
}
/// Whether a method's translucent surfaces are lit in the lighting pass, which then runs also where nothing is opaque.
[[nodiscard]] constexpr bool lit_with_opaque(Transparency t) noexcept {
    return t == Transparency::interleaved || t == Transparency::interleaved_skyx;
}
/// Whether a method draws translucent instances in the order of the scene, each once, with all its faces.
[[nodiscard]] constexpr bool any_order(Transparency t) noexcept {
    return t != Transparency::none && t != Transparency::sorted;
}

/// Whether lights cast shadows.
enum class Shadows : std::uint8_t {
    none,  ///< every light reaches every surface that faces it
    map    ///< opaque and masked surfaces cast, by shadow maps (passes/shadow_map.hpp)
};
/// As programs spell it.
[[nodiscard]] constexpr const char* name(Shadows s) noexcept {
    return s == Shadows::none ? "none" : "map";
}
/// [byte] Most that the shadow maps of a scene may take.
inline constexpr std::uint64_t max_shadow_bytes = std::uint64_t{1} << 31;

/// What a renderer is made with; to change it a renderer is made anew.
struct RenderSettings {
    Extent2D size{1280, 720};  ///< [texel] both in 1 … the device's limit
    Transparency transparency = Transparency::abuffer;
    GBufferLayout gbuffer = GBufferLayout::compact;
    ShadingStage shading = ShadingStage::compute;           ///< where lighting runs
    LightAssignment lighting = LightAssignment::automatic;  ///< how lights find the pixels that they reach
    Shadows shadows = Shadows::none;                        ///< of lights with Light::shadows
    std::uint32_t shadow_size = 1024;  ///< [texel] a side of each shadow map: 16 to the device's limit
    Brdf brdf = Brdf::gltf;
    ToneCurve tonemap = ToneCurve::neutral;
    float exposure_ev = 0;                      ///< radiance is multiplied by 2^exposure_ev before the tone curve
    glm::vec3 background{0.05f, 0.05f, 0.08f};  ///< linear radiance where nothing is
    Environment environment = {};               ///< light from all around
    bool default_light = true;                  ///< a scene without lights gets one sun and a constant ambient
    std::uint32_t max_layers = 0;     ///< of peel and peel_seed, passes of dual_peel; 0: all there are (peel_seed: 6)
    bool seed_composite = false;      ///< peel_seed: composite with the factors that its document has by mistake
    bool skyx_alpha_gain = false;     ///< interleaved_skyx: alpha of the picture grows by 1.1 a layer, as it once did
    float min_transmittance = 0;      ///< [0,1) exact methods end a pixel where less gets through; 0: nothing is lost
    std::uint64_t memory_budget = 0;  ///< [byte] of stored fragments, in rows of 2^14; 0: what the device can bind
    bool audit = false;               ///< keep, for each pixel, how many fragments were composited (tests)
    bool exact = false;               ///< lighting arithmetic that gives the same bits on every API, about 10 % slower
    bool keep_gbuffer = false;        ///< the G-buffer may be read back after a frame (Renderer::read_*)
    bool every_need = false;  ///< build everything whether the scene needs it or not (to prove that it changes nothing)
};

}  // namespace pellucid::inline v0_1
