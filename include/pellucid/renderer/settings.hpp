// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What a user may ask of the renderer.  Every default is what a first picture wants.
#include <pellucid/core/image.hpp>
#include <pellucid/passes/gbuffer.hpp>
#include <pellucid/passes/lighting.hpp>
#include <pellucid/passes/tonemap.hpp>
#include <glm/vec3.hpp>
#include <cstdint>

namespace pellucid {

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
[[nodiscard]] constexpr const char* name(Transparency t) noexcept {
    constexpr const char* names[] = {"none",      "sorted",           "peel",        "peel-seed",
                                     "dual-peel", "interleaved-skyx", "interleaved", "abuffer"};
    return names[static_cast<std::size_t>(t)];
}
/// Whether a method's translucent surfaces are lit in the lighting pass, which then runs also where nothing is opaque.
[[nodiscard]] constexpr bool lit_with_opaque(Transparency t) noexcept {
    return t == Transparency::interleaved || t == Transparency::interleaved_skyx;
}
/// Whether a method draws translucent instances in the order of the scene, each once, with all its faces.
[[nodiscard]] constexpr bool any_order(Transparency t) noexcept {
    return t != Transparency::none && t != Transparency::sorted;
}

struct RenderSettings {
    Extent2D size{1280, 720};  ///< [texel] both in 1 … the device's limit
    Transparency transparency = Transparency::sorted;
    GBufferLayout gbuffer = GBufferLayout::compact;
    ShadingStage shading = ShadingStage::compute;  ///< where lighting runs
    Brdf brdf = Brdf::gltf;
    ToneCurve tonemap = ToneCurve::neutral;
    float exposure_ev = 0;                      ///< radiance is multiplied by 2^exposure_ev before the tone curve
    glm::vec3 background{0.05f, 0.05f, 0.08f};  ///< linear radiance where nothing is
    bool default_light = true;                  ///< a scene without lights gets one sun and a constant ambient
    std::uint32_t max_layers = 0;     ///< of peel and peel_seed, passes of dual_peel; 0: all there are (peel_seed: 6)
    bool seed_composite = false;      ///< peel_seed: composite with the factors that its document has by mistake
    bool skyx_alpha_gain = false;     ///< interleaved_skyx: alpha of the picture grows by 1.1 a layer, as it once did
    float min_transmittance = 0;      ///< [0,1) exact methods end a pixel where less gets through; 0: nothing is lost
    std::uint64_t memory_budget = 0;  ///< [byte] of an A-buffer's fragments; 0: what the device can bind
    bool audit = false;               ///< keep, for each pixel, how many fragments were composited (tests)
    bool exact = false;               ///< lighting arithmetic that gives the same bits on every API, about 10 % slower
    bool keep_gbuffer = false;        ///< the G-buffer may be read back after a frame (Renderer::read_*)
    bool every_need = false;  ///< build everything whether the scene needs it or not (to prove that it changes nothing)
};

}  // namespace pellucid
