// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The reference renderer: whole scenes on the CPU, in double, from the formulae.  GPU pictures are judged by it.
///
/// A pixel is one sample at its centre (row 0 at the top).  Every triangle that covers it (raster.hpp) and is not
/// culled gives one fragment: back faces of single-sided materials are culled, front being counter-clockwise, or
/// clockwise where the instance is mirrored.  Fragments are sorted nearest first by their depth rounded to float; equal
/// bits: the later primitive in draw order is in front.  Draw order is opaque and masked instances in the scene's
/// order, then blended ones in the scene's order, and within an instance the order of its triangles.  Front to back
/// they are composited (composite.hpp) up to the first opaque one, or else the background.
///
/// Surfaces are those of surface.hpp, lit by lighting.hpp; unlit ones show their base colour.  A blended fragment's
/// whole radiance, lit, emitted or unlit, is multiplied by its alpha, unless its material is premultiplied.  Textures
/// are sampled (texture.hpp) with fine derivatives: differences between the centres of the pixel's 2×2 quad, attributes
/// extrapolated on the triangle's plane.  Each texture keeps its own size and sampler, whatever a GPU merges.  Radiance
/// has no upper limit here.
///
/// With shadows, a light does not reach a point where a triangle of an opaque or masked material, with its front
/// towards the light or double-sided, lies between them (masked ones where they are there, by level 0 of their
/// texture); blended ones cast none.  A point's own triangle never shadows it.
///
/// Link `pellucid::reference` (it needs TBB).
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/core/result.hpp>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/scene/environment.hpp>
#include <pellucid/scene/scene.hpp>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// Longest side of a picture.
inline constexpr std::uint32_t max_picture_side = 16384;

/// What the reference renderer draws with.
struct RenderOptions {
    Extent2D size{256, 256};           ///< [pixel] each side in 1 … `max_picture_side`
    glm::dvec3 background{0, 0, 0};    ///< linear radiance where nothing is; finite
    std::vector<Light> lights = {};    ///< used as they are: pass Scene::lights or a default light
    glm::dvec3 ambient{0, 0, 0};       ///< [cd/m²] the same radiance from everywhere; finite
    BrdfModel brdf = BrdfModel::gltf;  ///< of every lit surface
    Environment environment = {};      ///< light from all around; its backdrop replaces the background
    bool shadows = false;              ///< of lights with Light::shadows: exact and hard, see below
    bool translucent = true;           ///< false: blended surfaces are left out
    bool stability = false;            ///< also fill Picture::stable, at nine times the rasterisation
    /// N: corners in front of the eye are first moved to the nearest points of a grid of 1/N pixel, as devices move
    /// them before they rasterise (N = 256 on most); at most 65536.  0: they stay where they are.
    std::uint32_t corner_grid = 0;
    std::uint32_t threads = 0;  ///< at most this many; 0: as many as the machine has
    /// Called with the share that is done: rising, 1 at last, one call at a time, from any thread.  Null: not called.
    void (*progress)(void* user, double fraction) = nullptr;
    void* user = nullptr;  ///< passed to `progress`
    /// Any thread may set it: then no further tile of pixels is begun, and the picture is not complete.  Null: never.
    const std::atomic<bool>* stop = nullptr;
};

/// What it drew.
struct Picture {
    ImageF radiance;  ///< [h, w, 3] linear, before tone mapping; computed in double and rounded once
    /// [h, w, 1] blended fragments in front of the nearest opaque one, whatever their alpha.
    Image<std::uint32_t> layers;
    /// [h, w, 1] 255 where the fragments up to the first opaque one are the same primitives in the same order at the
    /// pixel's centre and at the eight points that are 1/64 pixel off along x, along y or along both, and no two that
    /// follow each other, and are not equal, have depths so close that a device may take them the other way round: one
    /// that rasterises on a grid of 1/256 pixel, and rounds to single precision; else 0.  Empty unless `stability` was
    /// asked for.
    Image8 stable;
    bool complete = true;  ///< false where RenderOptions::stop left pixels out: they are 0
};

/// One fragment of a pixel.
struct Fragment {
    double depth = 0;                   ///< [0,1] reversed: 1 near, 0 at the far end
    std::uint32_t primitive = 0;        ///< index of the triangle in draw order, over all instances
    std::uint32_t instance = 0;         ///< index into Scene::instances
    double alpha = 1;                   ///< [0,1] share of what lies behind that it hides
    glm::dvec3 radiance{0, 0, 0};       ///< [cd/m²] straight: before alpha
    glm::dvec3 premultiplied{0, 0, 0};  ///< [cd/m²] what it adds itself: radiance · alpha, or radiance
    bool opaque = false;                ///< of an opaque or masked material: it ends the pixel
};

/// Draws the scene.  The same bits for any number of threads.
/// Errors: Errc::invalid_argument for a size or a grid out of range, a camera or an instance that is not finite or out
/// of its documented range, a light that `validate` refuses, more than 2^32 − 2 triangles; Errc::out_of_memory.
[[nodiscard]] Result<Picture> render(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

/// The fragments that make pixel (x, y), row 0 at the top, nearest first: the blended ones in front of the nearest
/// opaque one, then that one, if there is any.  Every call prepares the whole scene, textures too.
/// Errors: as `render`, and a pixel outside of the picture.
[[nodiscard]] Result<std::vector<Fragment>> fragments_at(const Scene& scene, const Camera& camera,
                                                         const RenderOptions& options, std::uint32_t x,
                                                         std::uint32_t y);

}  // namespace pellucid::inline v0_1::reference

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/reference/renderer-inl.hpp>
#endif
