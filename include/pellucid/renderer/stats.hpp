// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The renderer's account of a frame.
#include <pellucid/graph/report.hpp>
#include <pellucid/renderer/settings.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// What the method of the last frame did, and what is missing from the picture.
struct TranslucencyStats {
    Transparency method = Transparency::none;
    bool ran = false;              ///< the scene has translucent surfaces, and the method drew them
    bool exact = false;            ///< no fragment is missing or in a wrong place, whatever the scene
    std::string loses;             ///< what may be missing or out of place; empty where `exact`
    std::uint32_t layers = 0;      ///< peel: peeled; peel_seed: drawn
    bool truncated = false;        ///< peel: max_layers left fragments out.  dual_peel: it may have
    std::uint32_t passes = 0;      ///< dual_peel: that found anything
    std::uint32_t bands = 0;       ///< abuffer, interleaved: of rows, made one after the other
    std::uint64_t pool_bytes = 0;  ///< abuffer, interleaved: [byte] for stored fragments
    std::uint64_t bytes = 0;       ///< [byte] of all targets, textures and buffers of the method, the pool too
};

/// What a frame took.  Bytes are of the renderer's own objects; the device's rings are apart.
struct RenderStats {
    std::vector<PassReport> passes;        ///< in order; left-out ones with the reason
    std::vector<TextureReport> resources;  ///< targets, the passes' own buffers and textures, the scene's
    std::uint64_t bytes = 0;               ///< their sum
    std::uint32_t pipelines = 0;           ///< built
    std::uint32_t draws = 0;               ///< a frame
    std::uint64_t triangles = 0;           ///< of the scene's instances
    std::uint32_t lights = 0;
    LightAssignment lighting = LightAssignment::loop;
    std::string lighting_why;  ///< where it is not the one that was asked for
    Shadows shadows = Shadows::none;
    std::string shadows_why;            ///< where they are not what was asked for
    std::uint32_t shadow_lights = 0;    ///< with shadow maps
    std::uint32_t shadow_maps = 0;      ///< that there is room for
    std::uint32_t shadows_drawn = 0;    ///< maps that the last frame drew
    TranslucencyStats translucency;     ///< of the last frame
    std::vector<std::string> warnings;  ///< of the scene and of its upload
};

}  // namespace pellucid::inline v0_1
