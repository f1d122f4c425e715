// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Cube maps as Vulkan and OpenGL define them, in double: faces, lookups across edges, mip chains.
///
/// Vulkan 1.3, "Cube Map Face Selection", and OpenGL 4.5, "Cube Map Texture Selection", agree; with r the direction and
/// m the magnitude of its largest component, u = (s/m + 1)/2, v = (t/m + 1)/2 from the face's first texel, row 0 first:
///   face   0 +x     1 −x     2 +y     3 −y     4 +z     5 −z
///   s      −r.z      r.z      r.x      r.x      r.x     −r.x
///   t      −r.y     −r.y      r.z     −r.z     −r.y     −r.y
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/reference/environment.hpp>
#include <pellucid/reference/quadrature.hpp>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// A place on a cube: a face, 0 to 5, and where on it, each in [0,1].
struct CubePlace {
    std::uint32_t face = 0;
    glm::dvec2 uv{0, 0};
};

/// Where `direction` (any length but 0) meets the cube.  Of equal magnitudes the later axis wins; the places on either
/// face are the same then.
[[nodiscard]] inline CubePlace cube_place(glm::dvec3 direction) noexcept;
/// The unit direction of a place; the inverse of `cube_place`.  `uv` may lie outside [0,1]: beyond an edge.
[[nodiscard]] inline glm::dvec3 cube_direction(std::uint32_t face, glm::dvec2 uv) noexcept;

/// Solid angle [sr] of the part of a face between two corners; 2π/3 for all of it.  In closed form: the rectangle from
/// the middle of the face to (x, y), both in [−1,1], has atan(x y/√(x² + y² + 1)).
[[nodiscard]] inline double cube_solid_angle(glm::dvec2 first, glm::dvec2 last) noexcept;

/// A cube map and its mip levels; `levels[l][f]` is `[size >> l, size >> l, 3]`.
struct CubeChain {
    std::uint32_t size = 0;  ///< [texel] of a side at level 0, a power of two
    std::vector<std::array<ImageF, 6>> levels;
    [[nodiscard]] double texels() const noexcept { return 6.0 * size * size; }  ///< of level 0
};

/// How a level is made of the one above: `box`, the mean of four texels, as GPUs make mips; `tent`, 1 3 3 1 over eight
/// in each direction, across edges (four bilinear taps, 3/4 of a texel from the middle).  `tent` is the transpose of
/// linear interpolation: it moves no light, its centre stays where it was to first order, which `box` shifts by up to
/// half a texel.  Where a sun is one texel of the source, that decides how exact all that is made of small levels is.
enum class CubeFilter : std::uint8_t { box, tent };

/// Level 0 is the mean of a radiance function over each texel, by `points`² Gauss points by area on the face; the next
/// ones are filtered, down to one texel a face.  Precondition: `size` is a power of two.
template <class Radiance>
[[nodiscard]] CubeChain make_cube_chain(const Radiance& radiance, std::uint32_t size,
                                        CubeFilter filter = CubeFilter::tent, std::size_t points = 2);

/// A texel of one level by its indices, which may be −1 or the size: then it is the texel on the other side of that
/// edge. At corners, where three faces meet and the fourth texel does not exist, the mean of the three.
[[nodiscard]] inline glm::dvec3 cube_texel(const std::array<ImageF, 6>& level, std::uint32_t face, std::int64_t x,
                                           std::int64_t y) noexcept;

/// The GGX-prefiltered radiance around `axis` (environment.hpp) as the sum over all texels of one level, each with its
/// solid angle and the lobe's weight at its middle.  No sample misses a sun; what is left is how much the lobe changes
/// within a texel.  Precondition: `level` exists.
[[nodiscard]] inline glm::dvec3 prefiltered_radiance(const CubeChain& cube, std::size_t level, glm::dvec3 axis,
                                                     double alpha) noexcept;

/// The smallest level whose sum is exact enough: at least max(64, 16/√α) texels a side, or level 0.  On a sunlit
/// picture (a sun of 1e5 times the mean) sums over it are within 0.1 to 0.2 % RMS of the integral from roughness 0.15
/// on, with `tent`; 1024 filtered samples (importance_sampling.hpp) are 2 to 4 % off, with `box` levels 4 to
/// 10 %.
[[nodiscard]] inline std::size_t prefilter_level(const CubeChain& cube, double alpha) noexcept;

/// Seamless trilinear lookup.  `lod` is clamped to the levels there are.
[[nodiscard]] inline glm::dvec3 sample_cube(const CubeChain& cube, glm::dvec3 direction, double lod = 0) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

CubePlace cube_place(glm::dvec3 r) noexcept {
    const glm::dvec3 m(std::abs(r.x), std::abs(r.y), std::abs(r.z));
    const auto place = [](std::uint32_t face, double s, double t, double major) {
        return CubePlace{face, {0.5 * (s / major + 1), 0.5 * (t / major + 1)}};
    };
    if (m.z >= m.x && m.z >= m.y) return r.z < 0 ? place(5, -r.x, -r.y, m.z) : place(4, r.x, -r.y, m.z);
    if (m.y >= m.x) return r.y < 0 ? place(3, r.x, -r.z, m.y) : place(2, r.x, r.z, m.y);
    return r.x < 0 ? place(1, r.z, -r.y, m.x) : place(0, -r.z, -r.y, m.x);
}

glm::dvec3 cube_direction(std::uint32_t face, glm::dvec2 uv) noexcept {
    const double s = 2 * uv.x - 1, t = 2 * uv.y - 1;
    const glm::dvec3 directions[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return glm::normalize(directions[face]);
}

double cube_solid_angle(glm::dvec2 first, glm::dvec2 last) noexcept {
    const auto corner = [](double u, double v) {
        const double x = 2 * u - 1, y = 2 * v - 1;
        return std::atan(x * y / std::sqrt(x * x + y * y + 1));
    };
    return corner(last.x, last.y) - corner(first.x, last.y) - corner(last.x, first.y) + corner(first.x, first.y);
}

template <class Radiance>
CubeChain make_cube_chain(const Radiance& radiance, std::uint32_t size, CubeFilter filter, std::size_t points) {
    assert(size > 0 && (size & (size - 1)) == 0);
    const QuadratureRule rule = gauss_legendre(points);
    CubeChain cube{size, {}};
    const auto sampled = [&](std::uint32_t face, std::uint32_t x, std::uint32_t y) {
        glm::dvec3 mean(0.0);
        for (std::size_t j = 0; j < points; ++j)
            for (std::size_t i = 0; i < points; ++i)
                mean += radiance(cube_direction(face, {(x + rule.at[i]) / size, (y + rule.at[j]) / size})) *
                        (rule.weight[i] * rule.weight[j]);
        return mean;
    };
    const std::array<double, 4> weight =
        filter == CubeFilter::tent ? std::array{0.125, 0.375, 0.375, 0.125} : std::array{0.0, 0.5, 0.5, 0.0};
    const auto filtered = [&](std::uint32_t face, std::uint32_t x, std::uint32_t y) {
        glm::dvec3 sum(0.0);
        for (std::uint32_t j = 0; j < 4; ++j)
            for (std::uint32_t i = 0; i < 4; ++i)
                sum += cube_texel(cube.levels.back(), face, std::int64_t{2} * x + i - 1, std::int64_t{2} * y + j - 1) *
                       (weight[i] * weight[j]);
        return sum;
    };
    for (std::uint32_t side = size; side > 0; side /= 2) {
        std::array<ImageF, 6> level;
        for (std::uint32_t face = 0; face < 6; ++face) {
            level[face] = ImageF(side, side, 3);
            for (std::uint32_t y = 0; y < side; ++y)
                for (std::uint32_t x = 0; x < side; ++x) {
                    const glm::dvec3 value = side == size ? sampled(face, x, y) : filtered(face, x, y);
                    for (int c = 0; c < 3; ++c) level[face].texel(x, y)[c] = static_cast<float>(value[c]);
                }
        }
        cube.levels.push_back(std::move(level));
    }
    return cube;
}

glm::dvec3 cube_texel(const std::array<ImageF, 6>& level, std::uint32_t face, std::int64_t x, std::int64_t y) noexcept {
    const std::int64_t side = level[face].width;
    const bool out_x = x < 0 || x >= side, out_y = y < 0 || y >= side;
    if (out_x && out_y) {
        const std::int64_t in_x = std::clamp<std::int64_t>(x, 0, side - 1),
                           in_y = std::clamp<std::int64_t>(y, 0, side - 1);
        return (cube_texel(level, face, in_x, in_y) + cube_texel(level, face, x, in_y) +
                cube_texel(level, face, in_x, y)) /
               3.0;
    }
    if (out_x || out_y) {
        // A step over the edge that is far shorter than a texel leaves the place along the edge as it is.
        constexpr double step = 1e-9;
        const auto over = [&](std::int64_t i) {
            return i < 0 ? -step : i >= side ? 1 + step : (static_cast<double>(i) + 0.5) / static_cast<double>(side);
        };
        const CubePlace place = cube_place(cube_direction(face, {over(x), over(y)}));
        const auto index = [&](double at) {
            return std::clamp<std::int64_t>(static_cast<std::int64_t>(at * static_cast<double>(side)), 0, side - 1);
        };
        return cube_texel(level, place.face, index(place.uv.x), index(place.uv.y));
    }
    const float* t = level[face].texel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    return {t[0], t[1], t[2]};
}

glm::dvec3 prefiltered_radiance(const CubeChain& cube, std::size_t level, glm::dvec3 axis, double alpha) noexcept {
    assert(level < cube.levels.size());
    const std::uint32_t side = cube.size >> level;
    const double step = 1.0 / side;
    glm::dvec3 sum(0.0);
    double total = 0;
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const glm::dvec2 first = glm::dvec2(x, y) * step;
                const glm::dvec3 difference = axis - cube_direction(face, first + 0.5 * step);
                double weight = prefilter_weight(0.5 * glm::dot(difference, difference), alpha);
                if (weight == 0) continue;
                weight *= cube_solid_angle(first, first + step);
                const float* t = cube.levels[level][face].texel(x, y);
                sum += glm::dvec3(t[0], t[1], t[2]) * weight;
                total += weight;
            }
    return sum / total;
}

std::size_t prefilter_level(const CubeChain& cube, double alpha) noexcept {
    const double side = std::max(64.0, 16 / std::sqrt(alpha));
    std::size_t level = 0;
    while (level + 1 < cube.levels.size() && (cube.size >> (level + 1)) >= side) ++level;
    return level;
}

glm::dvec3 sample_cube(const CubeChain& cube, glm::dvec3 direction, double lod) noexcept {
    const CubePlace place = cube_place(direction);
    const auto bilinear = [&](std::size_t l) {
        const double side = cube.size >> l, x = place.uv.x * side - 0.5, y = place.uv.y * side - 0.5;
        const auto left = static_cast<std::int64_t>(std::floor(x)), top = static_cast<std::int64_t>(std::floor(y));
        const double fx = x - std::floor(x), fy = y - std::floor(y);
        const auto texel = [&](int i, int j) { return cube_texel(cube.levels[l], place.face, left + i, top + j); };
        return (texel(0, 0) * (1 - fx) + texel(1, 0) * fx) * (1 - fy) +
               (texel(0, 1) * (1 - fx) + texel(1, 1) * fx) * fy;
    };
    const double clamped = std::clamp(lod, 0.0, static_cast<double>(cube.levels.size() - 1));
    const auto level = static_cast<std::size_t>(clamped);
    const double share = clamped - static_cast<double>(level);
    return share > 0 ? bilinear(level) * (1 - share) + bilinear(level + 1) * share : bilinear(level);
}

}  // namespace pellucid::inline v0_1::reference
