// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which fragments the pixels of a rectangle have, in order, and what each of them looks like.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <pellucid/reference/composite.hpp>
#include <pellucid/reference/detail/draws.hpp>
#include <pellucid/reference/detail/shadow_rays.hpp>
#include <span>
#include <vector>

namespace pellucid::inline v0_1::reference::detail {

/// A triangle met at a sample.
struct Hit {
    double depth = 0;
    std::uint32_t depth_bits = 0;  ///< of the depth as float: they rise with the depth, which is not negative
    std::uint32_t primitive = 0;
    std::uint32_t draw = 0;   ///< index into Prepared::draws
    std::uint32_t pixel = 0;  ///< in rows of the rectangle
};
/// The rule of order: nearer first, and among equal bits the later primitive.
[[nodiscard]] inline bool in_front(const Hit& a, const Hit& b) noexcept {
    return a.depth_bits != b.depth_bits ? a.depth_bits > b.depth_bits : a.primitive > b.primitive;
}

/// The hits of a rectangle's pixels, each pixel's nearest first and up to its first opaque one.
struct PixelHits {
    std::vector<Hit> hits;
    std::vector<std::uint32_t> ends;  ///< one past the last hit of each pixel
    [[nodiscard]] std::span<const Hit> of(std::uint32_t pixel) const noexcept {
        const std::uint32_t begin = pixel == 0 ? 0 : ends[pixel - 1];
        return {hits.data() + begin, ends[pixel] - begin};
    }
};

/// A sample: the centre of a pixel moved by (right, down)/64 pixel.
struct SamplePlace {
    std::int64_t x = 0, y = 0;
    int right = 0, down = 0;
    [[nodiscard]] SamplePoint point(Extent2D size, int columns = 0, int rows = 0) const noexcept {
        return sample_point(x + columns, y + rows, size, right, down);
    }
};

/// How far a device's depth of a hit at the centre of pixel (x, y) may be off: it moves corners to a grid of 1/256
/// pixel, by half a step at most in x and in y, and the triangle's plane with them; then it rounds.  Not finite for a
/// plane seen edge-on.
[[nodiscard]] inline double depth_doubt(const Prepared& prepared, const Hit& hit, std::int64_t x,
                                        std::int64_t y) noexcept {
    constexpr double half_step = 0.5 / 256;
    constexpr double rounding = 4 * 0x1p-23;  // four units in the last place
    const RasterTriangle triangle = prepared.triangle(prepared.draws[hit.draw], hit.primitive);
    const auto depth = [&](int columns, int rows) {
        return triangle.extrapolated_depth(SamplePlace{x, y}.point(prepared.options->size, columns, rows));
    };
    const double here = depth(0, 0), slope = std::abs(depth(1, 0) - here) + std::abs(depth(0, 1) - here);
    return half_step * slope + rounding * hit.depth;
}

/// Whether a device may see two fragments of a pixel, one behind the other, in the other order.  Equal depths are those
/// of the same triangle drawn twice: they come out equal everywhere.
[[nodiscard]] inline bool order_in_doubt(const Prepared& prepared, std::span<const Hit> hits, std::int64_t x,
                                         std::int64_t y) noexcept {
    double doubt = hits.size() < 2 ? 0 : depth_doubt(prepared, hits[0], x, y);
    for (std::size_t i = 1; i < hits.size(); ++i) {
        const double next = depth_doubt(prepared, hits[i], x, y);
        const double apart = std::abs(hits[i - 1].depth - hits[i].depth);
        if (apart != 0 && !(apart > doubt + next)) return true;
        doubt = next;
    }
    return false;
}

/// The triangle's attributes at a covered sample, and their change to the other column and row of the pixel's quad.
[[nodiscard]] inline Attributes attributes_at(const Prepared& prepared, const Draw& draw, std::uint32_t primitive,
                                              const RasterTriangle& triangle, const SamplePlace& place,
                                              UvDerivatives& change) noexcept {
    const std::uint32_t* at = draw.corners(primitive);
    const Attributes corners[3] = {vertex_attributes(*draw.mesh, draw.placed, at[0]),
                                   vertex_attributes(*draw.mesh, draw.placed, at[1]),
                                   vertex_attributes(*draw.mesh, draw.placed, at[2])};
    const Extent2D size = prepared.options->size;
    const int column = place.x % 2 == 0 ? 1 : -1, row = place.y % 2 == 0 ? 1 : -1;
    // All three by the same formula, so that what does not change has a derivative of exactly 0.
    const glm::dvec3 here = triangle.extrapolated_weights(place.point(size));
    const glm::dvec3 beside = triangle.extrapolated_weights(place.point(size, column, 0));
    const glm::dvec3 below = triangle.extrapolated_weights(place.point(size, 0, row));
    for (int set = 0; set < 2; ++set) {
        const auto uv = [&](const glm::dvec3& weights) {
            return mixed(corners[0].uv[set], corners[1].uv[set], corners[2].uv[set], weights);
        };
        change.dx[set] = (uv(beside) - uv(here)) * static_cast<double>(column);
        change.dy[set] = (uv(below) - uv(here)) * static_cast<double>(row);
    }
    return interpolated(corners, triangle.weights(place.point(size)));
}

/// Whether the sample of a masked triangle is there.
[[nodiscard]] inline bool passes_mask_at(const Prepared& prepared, const Draw& draw, std::uint32_t primitive,
                                         const RasterTriangle& triangle, const SamplePlace& place) noexcept {
    UvDerivatives change;
    const Attributes at = attributes_at(prepared, draw, primitive, triangle, place, change);
    return passes_mask(draw.material->factors, base_color(*draw.material, at, change).a);
}

/// Finds the hits in `rect` of `primitives`, ascending, with samples moved by (right, down)/64 pixel.
inline void find_hits(const Prepared& prepared, const PixelRect& rect, std::span<const std::uint32_t> primitives,
                      int right, int down, PixelHits& out) {
    const auto width = static_cast<std::uint32_t>(rect.right - rect.left);
    const auto pixels = width * static_cast<std::uint32_t>(rect.bottom - rect.top);
    const Extent2D size = prepared.options->size;
    const bool moved = right != 0 || down != 0;
    constexpr std::uint32_t none = ~0u;
    std::vector<Hit> opaque(pixels, Hit{.primitive = none});
    out.hits.clear();
    std::uint32_t d = 0;
    for (const std::uint32_t primitive : primitives) {
        while (prepared.draws[d].end_primitive <= primitive) ++d;
        const Draw& draw = prepared.draws[d];
        const RasterTriangle triangle = prepared.triangle(draw, primitive);
        const PixelRect box = intersection(rect, triangle.bounds(size, moved ? 1.0 / sample_steps : 0.0));
        if (box.empty() || triangle.misses(sample_point(box.left, box.top, size, right, down),
                                           sample_point(box.right - 1, box.bottom - 1, size, right, down)))
            continue;
        const bool blended = draw.blended(), masked = draw.material->factors.alpha_mode == AlphaMode::mask;
        for (std::int32_t y = box.top; y < box.bottom; ++y)
            for (std::int32_t x = box.left; x < box.right; ++x) {
                const SamplePoint sample = sample_point(x, y, size, right, down);
                if (!triangle.covers(sample)) continue;
                const std::optional<double> depth = triangle.depth(sample);
                if (!depth) continue;
                const auto pixel =
                    static_cast<std::uint32_t>(y - rect.top) * width + static_cast<std::uint32_t>(x - rect.left);
                const Hit hit{.depth = *depth,
                              .depth_bits = std::bit_cast<std::uint32_t>(static_cast<float>(*depth)),
                              .primitive = primitive,
                              .draw = d,
                              .pixel = pixel};
                // Opaque ones come first in draw order, so the nearest of them is known when blended ones come.
                Hit& nearest = opaque[pixel];
                if (nearest.primitive != none && !in_front(hit, nearest)) continue;
                if (blended)
                    out.hits.push_back(hit);
                else if (!masked || passes_mask_at(prepared, draw, primitive, triangle, {x, y, right, down}))
                    nearest = hit;
            }
    }
    for (const Hit& hit : opaque)
        if (hit.primitive != none) out.hits.push_back(hit);
    std::sort(out.hits.begin(), out.hits.end(),
              [](const Hit& a, const Hit& b) { return a.pixel != b.pixel ? a.pixel < b.pixel : in_front(a, b); });
    out.ends.assign(pixels, 0);
    for (const Hit& hit : out.hits) ++out.ends[hit.pixel];
    for (std::uint32_t i = 1; i < pixels; ++i) out.ends[i] += out.ends[i - 1];
}

/// Shades a hit at the centre of pixel (x, y).
[[nodiscard]] inline Fragment shade(const Prepared& prepared, const Hit& hit, std::int64_t x, std::int64_t y) {
    const Draw& draw = prepared.draws[hit.draw];
    const TexturedMaterial& material = *draw.material;
    const RenderOptions& options = *prepared.options;
    const RasterTriangle triangle = prepared.triangle(draw, hit.primitive);
    UvDerivatives change;
    const Attributes at = attributes_at(prepared, draw, hit.primitive, triangle, {x, y}, change);
    const glm::dvec4 base = base_color(material, at, change);
    Fragment fragment{.depth = hit.depth,
                      .primitive = hit.primitive,
                      .instance = draw.instance,
                      .alpha = fragment_alpha(material.factors, base.a),
                      .opaque = !draw.blended()};
    if (material.factors.unlit) {
        fragment.radiance = glm::dvec3(base);
    } else {
        const Surface<double> surface = surface_at(material, at, change, draw.front(triangle), prepared.backward());
        fragment.radiance = surface_radiance(
            surface, at.position, direction_to_eye(prepared.camera, at.position), options.lights, options.ambient,
            options.brdf,
            [&](const Light& light, const glm::dvec3& to_light) {
                return !options.shadows || !light.shadows ||
                       !in_shadow(prepared, at.position, hit.primitive, light, to_light);
            },
            prepared.environment ? &*prepared.environment : nullptr);
    }
    fragment.premultiplied =
        material.factors.premultiplied && draw.blended() ? fragment.radiance : fragment.radiance * fragment.alpha;
    return fragment;
}

}  // namespace pellucid::inline v0_1::reference::detail
