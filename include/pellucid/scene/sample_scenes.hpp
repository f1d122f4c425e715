// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Scenes of translucent surfaces that need no file: hard cases with known properties, for samples, tests and
/// benchmarks.  Each has one camera, for square and wider pictures, and the same arguments give the same scene.
/// Colours are linear and straight; translucent materials blend and are two-sided.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/scene.hpp>
#include <cstdint>
#include <vector>

namespace pellucid::inline v0_1 {

/// Depth peeling's classic demonstration: a translucent teapot (alpha 0.5), a pane (0.4) that cuts it and a sphere
/// (0.6) that is in both, lit by one sun.  Each is in front of each other one somewhere, so no order of the three is
/// right; six layers and more.  Best on a black background.
[[nodiscard]] Scene make_peeling_scene();

/// A necklace of `links` >= 6 tori, each through its two neighbours, unlit, alpha 0.5: every pair of neighbours is
/// linked (linking number ±1), no two links touch, and of linked ones each is in front of the other somewhere.  Link i
/// is instance i.
[[nodiscard]] Scene make_linked_chain(std::uint32_t links = 8);

/// Three unlit panes of the given alpha (in (0,1)), square and at right angles, that cross in one point inside an
/// opaque unlit cube.  The panes are the last three instances; each of their six orders is right in a part of the
/// picture.
[[nodiscard]] Scene make_intersecting_planes(float alpha = 0.5f);

/// An opaque floor, then `count` unlit translucent rectangles in all directions over it; of 64 most cross another one.
/// Each has one colour, with components k/255, k = 0 to 255, and alpha k/255, k = 51 to 204.
[[nodiscard]] Scene make_random_quads(std::uint32_t count = 64, std::uint32_t seed = 1);

/// Three unlit triangles of which each is in front of the next and the last in front of the first where they overlap
/// (M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the hidden surface problem", 1972): no two intersect, and
/// yet no order is right.
[[nodiscard]] Scene make_cyclic_triangles();

/// An opaque floor and a metal sphere; a lit translucent sphere, two panes that cross it and each other, a third that
/// crosses the first; a sun, a point light and a spot.  The seed chooses the glasses' colours and turns the panes.
[[nodiscard]] Scene make_lit_glass(std::uint32_t seed = 1);

/// A field of teapots, each `with_bottom`.
struct TeapotGrid {
    std::uint32_t columns = 11;    ///< >= 1, along x
    std::uint32_t rows = 10;       ///< >= 1, along z
    std::uint32_t divisions = 12;  ///< of each patch: `make_teapot`
};
/// Translucent, lit teapots over an opaque floor, under a sun: columns · rows · (64 n² - 8 n) translucent triangles,
/// 1,003,200 by default, in up to six materials and as many meshes; each teapot is an instance, row by row from the
/// back.  Pictures of 16:9 show all of it, a square one loses some at the sides.
[[nodiscard]] Scene make_teapot_grid(const TeapotGrid& grid = {});

/// One sheet of `make_sheets`.
struct Sheet {
    std::uint32_t slot = 128;        ///< depth in units of 2^-depth_bits, in 1 … 2^depth_bits - 1; greater is nearer
    glm::vec4 color{1, 1, 1, 0.5f};  ///< linear, straight, each in [0,1]
    bool opaque = false;             ///< then alpha is ignored
};
/// Unlit sheets across the whole view, square to an orthographic camera: every pixel of a picture up to four times as
/// wide as high has the same colour, in closed form.  Sheet i is instance i: of two in one slot the later one is in
/// front.
///
/// The camera sees distances from 0 to 1, so the reversed depth of a point at distance d is 1 - d.  Slot k is at
/// d = 1 - k 2^-n, n = `depth_bits` in 1 … 24: an integer below 2^24 times 2^-n, exact in float32, and so is
/// 1 - d: the depth of every point of the sheet is k 2^-n bit by bit, whatever the picture's size.  With 24 bits and
/// k >= 2^23, slots k and k + 1 are one ulp of depth apart.  A sheet is one triangle, so that no inner edge crosses the
/// picture.
[[nodiscard]] Scene make_sheets(const std::vector<Sheet>& sheets, std::uint32_t depth_bits = 8);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/sample_scenes-inl.hpp>
#endif
