// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// When drawing whole instances back to front cannot be trusted to be exact: found on the CPU, before anything is
/// drawn.
///
/// Sorting draws translucent instances by the view depth of the middle of their bounds, farthest first, and each
/// double-sided one as its back faces, then its front faces.  That is the true order of every pixel's fragments where
/// two things hold.
///
/// *No two instances overlap both in depth and on screen.*  Judged by the bounds of the eight corners in view space,
/// cut at the near plane, with a margin of 1/64 pixel and 1e-6 in depth for what rounding moves.
///
/// *No instance overlaps itself* but for one back face behind one front face.  Proved in one of two ways from its
/// triangles, welded by position, in time O(n log n); whatever fits neither is taken to overlap itself.
/// - A sheet: seen along its mean normal, all triangles turn the same way and what is left of their edges, after those
///   that two triangles share in opposite directions, is one convex polygon; so, by winding numbers, they cover it
///   once. A line that crosses such a sheet twice crosses it from both sides; so it is enough that it is flat, or that
///   all triangles turn the same side to the eye.
/// - A shell: every edge is shared by exactly two triangles in opposite directions; all triangles face away from one
///   point inside, and the solid angles they fill there add up to one sphere.  Then a line leaves the body and enters
///   it again only over a valley: an edge where the surface is not convex, one of whose sides faces the eye and the
///   other does not.  It is enough that there is none, and that the eye is outside of the bounds or no edge is a
///   valley.
#include <pellucid/core/config.hpp>
#include <pellucid/scene/scene.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// What the detector found.  Instances are indices into Scene::instances, in rising order.
struct SortConflicts {
    /// Two translucent instances without a right order.
    struct Pair {
        std::uint32_t first = 0, second = 0;  ///< first < second
        friend bool operator==(const Pair&, const Pair&) = default;
    };
    static constexpr std::size_t most_listed = 64;  ///< the lists end here; the counts go on

    std::uint32_t instances = 0;                  ///< translucent ones that may be in the picture
    std::vector<Pair> pairs;                      ///< that overlap in depth and on screen
    std::vector<std::uint32_t> self_overlapping;  ///< that may cover a pixel twice with one side
    std::uint64_t pair_count = 0;                 ///< a lower bound where not `complete`
    std::uint32_t self_count = 0;
    bool complete = true;  ///< false: too many instances share depths to compare them all, so conflicts are assumed

    /// Where true, sorting composites every pixel in the true order; of an instance's back and front fragment whose
    /// depths are equal in float (where its sides meet) the front one ends up in front.  Where false, it may still.
    [[nodiscard]] bool exact() const noexcept { return complete && pair_count == 0 && self_count == 0; }
};

/// Judges the translucent instances (AlphaMode::blend) of `scene` as `camera` sees them on a picture of `size`.
/// Precondition: both sides of `size` are > 0.
[[nodiscard]] SortConflicts find_sort_conflicts(const Scene& scene, const Camera& camera, Extent2D size);

/// One sentence for a person: what conflicts, with the first few instances by number; empty where `exact`.
[[nodiscard]] std::string to_text(const SortConflicts& conflicts);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/sort_conflicts-inl.hpp>
#endif
