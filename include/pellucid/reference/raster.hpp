// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Which pixel centres a triangle covers, how deep, and with what weights of its corners: 2D homogeneous edge functions
/// (Olano and Greer 1997, "Triangle Scan Conversion using 2D Homogeneous Coordinates"), so that nothing is clipped and
/// a triangle may reach behind the eye.
///
/// With v0, v1, v2 the corners' (x, y, w) in clip space and p = (x, y, 1) a point in normalised device coordinates, the
/// ray through p meets the triangle in front of the eye (w > 0) exactly where det(v1,v2,p), det(v2,v0,p) and
/// det(v0,v1,p) have the sign of det(v0,v1,v2).  Signs are exact (determinant.hpp), so a shared edge never leaves or
/// doubles a centre.  A centre on an edge belongs to the triangle where the edge is its left or its top one on screen.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <pellucid/core/image.hpp>
#include <pellucid/reference/determinant.hpp>
#include <pellucid/scene/camera.hpp>
#include <utility>

namespace pellucid::inline v0_1::reference {

/// View space [m] → clip space.
[[nodiscard]] inline glm::dvec4 clip_from_point(const ClipFromView& clip, const glm::dvec3& e) noexcept {
    return {e.x * clip.sx + clip.ox, e.y * clip.sy + clip.oy, e.z * clip.zz + clip.zw, e.z * clip.wz + clip.ww};
}

/// A point of the picture in homogeneous normalised device coordinates, (x/w, y/w), y up, with whole numbers for x, y
/// and w: exact for sides up to 65536.
struct SamplePoint {
    double x = 0, y = 0, w = 1;
};

/// Steps of a sample's offset in a pixel.
inline constexpr int sample_steps = 64;

/// The centre of pixel (x, y), row 0 at the top, moved by (right, down)/64 pixel.
[[nodiscard]] inline SamplePoint sample_point(std::int64_t x, std::int64_t y, Extent2D size, int right = 0,
                                              int down = 0) noexcept {
    const std::int64_t w = size.width, h = size.height;
    constexpr std::int64_t half = sample_steps / 2;
    return {static_cast<double>((half * (2 * x + 1 - w) + right) * h),
            static_cast<double>((half * (h - 1 - 2 * y) - down) * w), static_cast<double>(half * w * h)};
}

/// Pixels [left, right) × [top, bottom).
struct PixelRect {
    std::int32_t left = 0, top = 0, right = 0, bottom = 0;
    [[nodiscard]] bool empty() const noexcept { return left >= right || top >= bottom; }
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};
/// The pixels of both.
[[nodiscard]] inline PixelRect intersection(const PixelRect& a, const PixelRect& b) noexcept {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

/// The corners' values mixed with weights whose sum is 1.  The corner that weighs most is moved by its differences to
/// the others: equal values stay what they are to the bit, and far corners of little weight cost no digits.
template <class T>
[[nodiscard]] T mixed(const T& a, const T& b, const T& c, const glm::dvec3& weights) noexcept {
    const glm::dvec3 k = glm::abs(weights);
    if (k.x >= k.y && k.x >= k.z) return a + ((b - a) * weights.y + (c - a) * weights.z);
    if (k.y >= k.z) return b + ((c - b) * weights.z + (a - b) * weights.x);
    return c + ((a - c) * weights.x + (b - c) * weights.y);
}

/// One triangle, prepared.  Corners are in clip space with reversed depth.
class RasterTriangle {
public:
    RasterTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) noexcept;

    /// 1: counter-clockwise as seen from the eye, −1: clockwise, 0: seen edge-on, or a coordinate is not finite.
    [[nodiscard]] int facing() const noexcept { return facing_; }

    /// A rectangle of pixels outside of which no sample is covered; samples may lie `margin` pixels off the centres.
    [[nodiscard]] PixelRect bounds(Extent2D size, double margin = 0) const noexcept;

    /// True only where no sample of the box between two samples (left top and right bottom) is covered.
    [[nodiscard]] bool misses(const SamplePoint& left_top, const SamplePoint& right_bottom) const noexcept;

    /// Whether the triangle is met, in front of the eye, at the sample; depth is not looked at.
    /// Precondition: the sample lies in the picture.
    [[nodiscard]] bool covers(const SamplePoint& sample) const noexcept;

    /// Depth of the triangle's plane at a covered sample, clip.z/clip.w, in [0,1]; nothing where it is nearer than the
    /// near plane (1) or beyond the far end (0).  A triangle whose corners are all in range is never cut by rounding.
    [[nodiscard]] std::optional<double> depth(const SamplePoint& sample) const noexcept;

    /// The same at any sample, extrapolated and not limited to [0,1].  Not finite where the ray is parallel to the
    /// plane.
    [[nodiscard]] double extrapolated_depth(const SamplePoint& sample) const noexcept {
        const glm::dvec3 k = extrapolated_weights(sample);
        return mixed(v_[0].z, v_[1].z, v_[2].z, k) / mixed(v_[0].w, v_[1].w, v_[2].w, k);
    }

    /// Perspective-correct weights of the corners at a covered sample: each in [0,1], sum 1.
    [[nodiscard]] glm::dvec3 weights(const SamplePoint& sample) const noexcept;

    /// The same at any sample, extrapolated on the triangle's plane.  Not finite where the ray is parallel to the
    /// plane.
    [[nodiscard]] glm::dvec3 extrapolated_weights(const SamplePoint& sample) const noexcept {
        const glm::dvec3 e = accurate_edges(sample);
        return e / (e.x + e.y + e.z);
    }

private:
    [[nodiscard]] glm::dvec3 corner(int i) const noexcept { return {v_[i].x, v_[i].y, v_[i].w}; }
    [[nodiscard]] bool owns_boundary(int edge) const noexcept;
    [[nodiscard]] glm::dvec3 accurate_edges(const SamplePoint& sample) const noexcept;

    glm::dvec4 v_[3];
    glm::dvec3 normal_[3];  ///< edge i runs from corner i + 1 to i + 2: positive inside, up to rounding
    double doubt_[3];       ///< per unit of sample.w: the sign of a smaller value must be found exactly
    int facing_ = 0;
};

// ---------------------------------------------------------------------------------------------------- bodies

inline RasterTriangle::RasterTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) noexcept
    : v_{a, b, c} {
    // Two roundings in an element of the cross product and three in the sum: 5.1 · 2⁻⁵³ of the sum of magnitudes.
    constexpr double unit = 8 * 0x1p-53;
    double magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 p = corner((i + 1) % 3), q = corner((i + 2) % 3);
        const glm::dvec3 first(p.y * q.z, p.z * q.x, p.x * q.y), second(p.z * q.y, p.x * q.z, p.y * q.x);
        const glm::dvec3 size = glm::abs(first) + glm::abs(second);
        normal_[i] = first - second;
        doubt_[i] = unit * (size.x + size.y + size.z);
        if (i == 0) magnitude = glm::dot(glm::abs(corner(0)), size);
    }
    const double determinant = glm::dot(corner(0), normal_[0]);
    if (!std::isfinite(determinant) || !std::isfinite(magnitude)) return;
    if (std::abs(determinant) > unit * magnitude)
        facing_ = determinant > 0 ? 1 : -1;
    else
        facing_ = sign_of_determinant(corner(0), corner(1), corner(2));
    for (glm::dvec3& n : normal_) n *= facing_;
}

inline PixelRect RasterTriangle::bounds(Extent2D size, double margin) const noexcept {
    const PixelRect whole{0, 0, static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height)};
    if (facing_ == 0) return {};
    const auto all = [&](auto&& condition) { return condition(v_[0]) && condition(v_[1]) && condition(v_[2]); };
    // Beyond one side of the view volume with all corners, and so with every point; samples lie strictly inside.
    if (all([](const glm::dvec4& p) { return p.x >= p.w; }) || all([](const glm::dvec4& p) { return -p.x >= p.w; }) ||
        all([](const glm::dvec4& p) { return p.y >= p.w; }) || all([](const glm::dvec4& p) { return -p.y >= p.w; }) ||
        all([](const glm::dvec4& p) { return p.z > p.w; }) || all([](const glm::dvec4& p) { return p.z < 0; }))
        return {};
    if (!all([](const glm::dvec4& p) { return p.w > 0; })) return whole;
    const auto range = [&](int axis, std::uint32_t count) {
        const double a = v_[0][axis] / v_[0].w, b = v_[1][axis] / v_[1].w, c = v_[2][axis] / v_[2].w;
        const double half = 0.5 * count, slack = margin + 1e-9 * count;  // rounding: below 1e-15 of the count
        // Centre i lies at i + 0.5.
        const double low = std::ceil((std::min({a, b, c}) + 1) * half - 0.5 - slack);
        const double high = std::floor((std::max({a, b, c}) + 1) * half - 0.5 + slack);
        return std::pair{static_cast<std::int32_t>(std::clamp(low, 0.0, static_cast<double>(count))),
                         static_cast<std::int32_t>(std::clamp(high + 1, 0.0, static_cast<double>(count)))};
    };
    const auto [left, right] = range(0, size.width);
    const auto [below, above] = range(1, size.height);  // counted from the bottom
    return {left, whole.bottom - above, right, whole.bottom - below};
}

inline bool RasterTriangle::misses(const SamplePoint& left_top, const SamplePoint& right_bottom) const noexcept {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& n = normal_[i];
        const double x = n.x > 0 ? right_bottom.x : left_top.x, y = n.y > 0 ? left_top.y : right_bottom.y;
        if (n.x * x + (n.y * y + n.z * left_top.w) < -doubt_[i] * left_top.w) return true;
    }
    return false;
}

inline bool RasterTriangle::covers(const SamplePoint& sample) const noexcept {
    if (facing_ == 0) return false;
    for (int i = 0; i < 3; ++i) {
        const double e = normal_[i].x * sample.x + (normal_[i].y * sample.y + normal_[i].z * sample.w);
        const double doubt = doubt_[i] * sample.w;
        if (e > doubt) continue;
        if (e < -doubt) return false;
        const int sign =
            facing_ * sign_of_determinant(corner((i + 1) % 3), corner((i + 2) % 3), {sample.x, sample.y, sample.w});
        if (sign < 0 || (sign == 0 && !owns_boundary(i))) return false;
    }
    return true;
}

/// Left edge: the inside is to the right.  Top edge: horizontal, the inside is below.
inline bool RasterTriangle::owns_boundary(int edge) const noexcept {
    const glm::dvec3 p = corner((edge + 1) % 3), q = corner((edge + 2) % 3);
    const int to_right = facing_ * sign_of_difference(p.y, q.z, p.z, q.y);
    return to_right != 0 ? to_right > 0 : facing_ * sign_of_difference(p.z, q.x, p.x, q.z) < 0;
}

/// det(p,q,sample) = cross(p', q')/sample.w with p' = p.xy sample.w − sample.xy p.w: moving the origin to the sample
/// first keeps the digits of small triangles.
inline glm::dvec3 RasterTriangle::accurate_edges(const SamplePoint& sample) const noexcept {
    double x[3], y[3];
    for (int i = 0; i < 3; ++i) {
        x[i] = difference_of_products(v_[i].x, sample.w, v_[i].w, sample.x);
        y[i] = difference_of_products(v_[i].y, sample.w, v_[i].w, sample.y);
    }
    const auto edge = [&](int p, int q) { return facing_ * difference_of_products(x[p], y[q], y[p], x[q]); };
    return {edge(1, 2), edge(2, 0), edge(0, 1)};
}

inline glm::dvec3 RasterTriangle::weights(const SamplePoint& sample) const noexcept {
    // A covered sample has none below 0 but for rounding in a triangle thinner than that.
    const glm::dvec3 e = glm::max(accurate_edges(sample), glm::dvec3(0));
    const double sum = e.x + e.y + e.z;
    return sum > 0 ? e / sum : glm::dvec3(1.0 / 3.0);
}

inline std::optional<double> RasterTriangle::depth(const SamplePoint& sample) const noexcept {
    const glm::dvec3 k = weights(sample);
    const double z = mixed(v_[0].z, v_[1].z, v_[2].z, k), w = mixed(v_[0].w, v_[1].w, v_[2].w, k);
    const bool reaches_near = v_[0].z > v_[0].w || v_[1].z > v_[1].w || v_[2].z > v_[2].w;
    const bool reaches_far = v_[0].z < 0 || v_[1].z < 0 || v_[2].z < 0;
    if ((reaches_near && z > w) || (reaches_far && z < 0)) return std::nullopt;
    return std::clamp(z / w, 0.0, 1.0);
}

}  // namespace pellucid::inline v0_1::reference
