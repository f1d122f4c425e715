// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the G-buffer stores and how it is read back: octahedral normals, the `compact` layout's packing, positions from
/// reversed depth.  Templates on the floating type: `double` is the reference, `float` emulates a shader.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <pellucid/core/image.hpp>
#include <pellucid/reference/brdf.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/scene/camera.hpp>

namespace pellucid::inline v0_1::reference {

// ---------------------------------------------------------------------------------------------------- normals

/// Unit vector → octahedron unfolded to [−1,1]² (Meyer et al. 2010): divide by |x|+|y|+|z|; where z < 0 fold outward,
/// (1 − |y|, 1 − |x|) with the signs of x and y, the sign of ±0 being +1.
template <std::floating_point T>
[[nodiscard]] glm::vec<2, T> octahedron_from_direction(glm::vec<3, T> direction) noexcept;

/// The inverse: a unit vector.  Any point of [−1,1]² has one.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> direction_from_octahedron(glm::vec<2, T> point) noexcept;

/// Unit vector → two 16-bit snorm codes, x in the low half and y in the high half (the layout of packSnorm2x16).  Of
/// the four codes around the exact point the one whose direction is nearest is taken ("precise" rounding, Cigolle et
/// al. 2014): largest error 0.0025°, exact on the six axes.  Zero, infinite and NaN vectors give code 0, which is +z.
template <std::floating_point T>
[[nodiscard]] std::uint32_t oct32_from_direction(glm::vec<3, T> direction) noexcept;

/// Two snorm codes → unit vector; −32768 reads as −1, as GPUs do.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> direction_from_oct32(std::uint32_t code) noexcept;

// ---------------------------------------------------------------------------------------------------- compact layout

/// One texel of the `compact` layout: 16 bytes.
struct CompactTexel {
    std::uint32_t normal = 0;    ///< R32UI: `oct32_from_direction`
    std::uint32_t color = 0;     ///< RGBA8 sRGB: base colour encoded, occlusion linear in the last byte; R lowest
    std::uint32_t material = 0;  ///< R32UI: roughness in bits 0–15, metallic in 16–23, flags in 24–31
    float depth = 0;             ///< D32F: reversed; 0 is background
    friend constexpr bool operator==(const CompactTexel&, const CompactTexel&) = default;
};

/// roughness16 | metallic8 | flags8; each unorm is rounded to nearest, values outside [0,1] are limited, NaN gives 0.
template <std::floating_point T>
[[nodiscard]] std::uint32_t pack_material(T roughness, T metallic, std::uint8_t flags) noexcept;

/// The quantised surface, all but its depth.  Emissive light is not in this layout.
template <std::floating_point T>
[[nodiscard]] CompactTexel pack_surface(const Surface<T>& surface, std::uint8_t flags, float depth) noexcept;

template <std::floating_point T>
[[nodiscard]] Surface<T> unpack_surface(const CompactTexel& texel) noexcept;

/// The flags of a packed material.
[[nodiscard]] constexpr std::uint8_t material_flags(std::uint32_t material) noexcept {
    return static_cast<std::uint8_t>(material >> 24u);
}

// ---------------------------------------------------------------------------------------------------- position

/// Centre of pixel (x, y), row 0 at the top → normalised device coordinates, y up.
template <std::floating_point T>
[[nodiscard]] glm::vec<2, T> ndc_from_pixel(std::uint32_t x, std::uint32_t y, Extent2D size) noexcept {
    return {(T(2) * static_cast<T>(x) + T(1)) / static_cast<T>(size.width) - T(1),
            T(1) - (T(2) * static_cast<T>(y) + T(1)) / static_cast<T>(size.height)};
}

/// `ClipFromView` rounded to `T`.
template <std::floating_point T>
struct ClipCoefficients {
    T sx, sy, ox, oy, zz, zw, wz, ww;
    explicit ClipCoefficients(const ClipFromView& c) noexcept
        : sx(T(c.sx)), sy(T(c.sy)), ox(T(c.ox)), oy(T(c.oy)), zz(T(c.zz)), zw(T(c.zw)), wz(T(c.wz)), ww(T(c.ww)) {}
};

/// Stored depth of a point in view space: (z zz + zw)/(z wz + ww); near/−z for a perspective camera.
/// Precondition: the point is in front of the eye.
template <std::floating_point T>
[[nodiscard]] T depth_from_view(const ClipCoefficients<T>& clip, glm::vec<3, T> view) noexcept {
    return (view.z * clip.zz + clip.zw) / (view.z * clip.wz + clip.ww);
}

/// Point in view space [m] from its depth: z = (d ww − zw)/(zz − d wz), w = z wz + ww, x = (ndc.x w − ox)/sx, and so y.
/// For a perspective camera z is −near/d: one division, no matrix, no cancellation, whatever far/near is.
/// The result is relative to the eye, and only a rotation (`relative_from_view`) away from camera-relative world axes:
/// the camera's own position never enters.  Precondition: depth > 0 (0 is background).
/// In float: |Δp|/|p| <= 2e-7 for far/near up to 1e6 and any camera position, where the eye is subtracted and the view
/// rotated in double before the vertices become float; <= 4e-7 where float also rotates into view space and back.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> view_from_depth(const ClipCoefficients<T>& clip, glm::vec<2, T> ndc, T depth) noexcept {
    const T z = (depth * clip.ww - clip.zw) / (clip.zz - depth * clip.wz);
    const T w = z * clip.wz + clip.ww;
    return {(ndc.x * w - clip.ox) / clip.sx, (ndc.y * w - clip.oy) / clip.sy, z};
}

/// View space → world axes with the eye at the origin [m]: the columns of `world_from_view`, without its translation.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> relative_from_view(const Camera& camera, glm::vec<3, T> view) noexcept {
    const glm::dmat4& m = camera.world_from_view;
    return glm::vec<3, T>(m[0]) * view.x + glm::vec<3, T>(m[1]) * view.y + glm::vec<3, T>(m[2]) * view.z;
}

// ---------------------------------------------------------------------------------------------------- bodies

template <std::floating_point T>
glm::vec<2, T> octahedron_from_direction(glm::vec<3, T> direction) noexcept {
    const T sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    const glm::vec<2, T> p(direction.x / sum, direction.y / sum);
    if (direction.z >= T(0)) return p;
    const T u = T(1) - std::abs(p.y), v = T(1) - std::abs(p.x);
    return {p.x >= T(0) ? u : -u, p.y >= T(0) ? v : -v};
}

template <std::floating_point T>
glm::vec<3, T> direction_from_octahedron(glm::vec<2, T> point) noexcept {
    glm::vec<3, T> v(point.x, point.y, T(1) - std::abs(point.x) - std::abs(point.y));
    if (v.z < T(0)) {
        const T x = T(1) - std::abs(point.y), y = T(1) - std::abs(point.x);
        v.x = point.x >= T(0) ? x : -x;
        v.y = point.y >= T(0) ? y : -y;
    }
    return v / std::sqrt(glm::dot(v, v));
}

template <std::floating_point T>
glm::vec<3, T> direction_from_oct32(std::uint32_t code) noexcept {
    const auto decode = [](std::uint32_t half) {
        return std::max(static_cast<T>(static_cast<std::int16_t>(half & 0xFFFFu)) / T(32767), T(-1));
    };
    return direction_from_octahedron(glm::vec<2, T>(decode(code), decode(code >> 16u)));
}

template <std::floating_point T>
std::uint32_t oct32_from_direction(glm::vec<3, T> direction) noexcept {
    const T sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > T(0)) || !std::isfinite(sum)) return 0;
    const glm::vec<2, T> exact = octahedron_from_direction(direction) * T(32767);
    const T x0 = std::floor(exact.x), y0 = std::floor(exact.y);
    const auto code = [](T value) {
        const auto limited = static_cast<std::int32_t>(std::clamp(value, T(-32767), T(32767)));
        return static_cast<std::uint32_t>(limited) & 0xFFFFu;
    };
    std::uint32_t best = 0;
    T best_distance = T(8);
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t candidate = code(x0 + T(i & 1)) | code(y0 + T(i >> 1)) << 16u;
        const glm::vec<3, T> off = direction_from_oct32<T>(candidate) - direction;
        const T distance = glm::dot(off, off);  // a dot product with `direction` would have no digits left
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

template <std::floating_point T>
std::uint32_t pack_material(T roughness, T metallic, std::uint8_t flags) noexcept {
    const T r = roughness > T(0) ? std::min(roughness, T(1)) : T(0);
    const auto roughness16 = static_cast<std::uint32_t>(r * T(65535) + T(0.5));
    return roughness16 | std::uint32_t{unorm8(metallic)} << 16u | std::uint32_t{flags} << 24u;
}

template <std::floating_point T>
CompactTexel pack_surface(const Surface<T>& surface, std::uint8_t flags, float depth) noexcept {
    std::uint32_t color = std::uint32_t{unorm8(surface.occlusion)} << 24u;
    for (int i = 0; i < 3; ++i) color |= std::uint32_t{srgb8_from_linear(surface.base_color[i])} << 8 * i;
    return {oct32_from_direction(surface.normal), color, pack_material(surface.roughness, surface.metallic, flags),
            depth};
}

/// The surface that a texel stands for.
template <std::floating_point T>
Surface<T> unpack_surface(const CompactTexel& texel) noexcept {
    Surface<T> surface;
    surface.normal = direction_from_oct32<T>(texel.normal);
    for (int i = 0; i < 3; ++i)
        surface.base_color[i] = linear_from_srgb8<T>(static_cast<std::uint8_t>(texel.color >> 8 * i));
    surface.occlusion = static_cast<T>(texel.color >> 24u) / T(255);
    surface.roughness = static_cast<T>(texel.material & 0xFFFFu) / T(65535);
    surface.metallic = static_cast<T>(texel.material >> 16u & 0xFFu) / T(255);
    return surface;
}

}  // namespace pellucid::inline v0_1::reference
