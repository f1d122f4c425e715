// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// How wrong each encoding is: tables of errors without any cost.  Seeds are fixed; no device is needed.
#include <limits>
#include <numbers>
#include <random>
#include "encodings/normals.hpp"
#include "encodings/positions.hpp"
#include "encodings/scalars.hpp"
#include "support/error_sample.hpp"
#include "support/speed_error.hpp"

namespace pellucid::bench {

/// A seeded sequence that is the same with every standard library.
class EncodingRandom {
public:
    explicit EncodingRandom(std::uint64_t seed) : engine_(seed) {}
    /// Uniform in [low, high).
    double uniform(double low = 0, double high = 1) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11u) * 0x1p-53);
    }
    /// Uniform on the unit sphere.
    glm::dvec3 direction() {
        const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 engine_;
};

/// Angle between two vectors [degree], exact also where it is tiny, whatever their lengths.
[[nodiscard]] inline double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

/// The error of one direction [degree]: rounded to float, encoded, decoded.
[[nodiscard]] inline double normal_error(const NormalEncoding& encoding, glm::dvec3 direction) {
    const glm::vec3 back = decode_normal(encoding, encode_normal(encoding, glm::vec3(direction)));
    return angle_between(glm::dvec3(back), direction);
}

/// The six axes, with zeros of both signs.
[[nodiscard]] inline std::vector<glm::dvec3> axis_directions() {
    std::vector<glm::dvec3> out;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            for (int zeros = 0; zeros < 4; ++zeros) {
                glm::dvec3 d(0);
                d[axis] = sign;
                d[(axis + 1) % 3] = zeros & 1 ? -0.0 : 0.0;
                d[(axis + 2) % 3] = zeros & 2 ? -0.0 : 0.0;
                out.push_back(d);
            }
    return out;
}

/// Directions on the octahedron's folds, where one component is zero (of either sign), and beside them, `count` for
/// each fold and distance.
[[nodiscard]] inline std::vector<glm::dvec3> fold_directions(int count) {
    std::vector<glm::dvec3> out;
    for (int fold = 0; fold < 3; ++fold)
        for (const double beside : {0.0, -0.0, 1e-30, -1e-30, 1e-7, -1e-7, 1e-4, -1e-4})
            for (int i = 0; i < count; ++i) {
                // An offset keeps the angles off the axes, which are judged apart, and off the diagonals.
                const double angle = 2 * std::numbers::pi * (i + 0.37) / count;
                glm::dvec3 d(0);
                d[fold] = beside;
                d[(fold + 1) % 3] = std::cos(angle);
                d[(fold + 2) % 3] = std::sin(angle);
                out.push_back(d);
            }
    return out;
}

[[nodiscard]] inline double max_of(const ErrorSample& sample) {
    return sample.nonfinite() > 0 ? std::numeric_limits<double>::infinity() : sample.max();
}

/// A row for `sample`; the bytes of a picture are for whoever knows its size.
[[nodiscard]] inline SpeedErrorRow error_row(const char* family, const char* name, const ErrorSample& sample,
                                             double bytes, std::vector<NamedNumber> more) {
    more.insert(more.begin(), {"B/pixel", bytes});
    const bool finite = sample.nonfinite() == 0;
    return {.scene = family,
            .method = name,
            .setting = {},
            .milliseconds = {},
            .rmse = finite ? sample.rms() : std::numeric_limits<double>::infinity(),
            .p999 = finite ? sample.p999() : std::numeric_limits<double>::infinity(),
            .max_error = max_of(sample),
            .more = std::move(more)};
}

[[nodiscard]] inline SpeedErrorTable normal_errors(bool quick) {
    SpeedErrorTable table{.stem = "encodings: normals", .baseline = "cheapest", .error = "angle [degree]"};
    const int count = quick ? 20000 : 1000000;
    std::vector<glm::dvec3> directions(static_cast<std::size_t>(count));
    EncodingRandom random(1);
    for (glm::dvec3& d : directions) d = random.direction();
    const auto folds = fold_directions(quick ? 400 : 4000);
    for (const NormalEncoding& encoding : normal_encodings) {
        ErrorSample all, axes, on_folds;
        double sum = 0;
        for (const glm::dvec3& d : directions) {
            const double error = normal_error(encoding, d);
            sum += error;
            all.add(error);
        }
        for (const glm::dvec3& d : axis_directions()) axes.add(normal_error(encoding, d));
        for (const glm::dvec3& d : folds) on_folds.add(normal_error(encoding, d));
        table.rows.push_back(
            error_row("normals", encoding.name, all, encoding.bytes,
                      {{"mean", sum / count}, {"axes, max", max_of(axes)}, {"folds, max", max_of(on_folds)}}));
    }
    table.notes = {std::to_string(count) +
                   " uniform directions in float; axes: all six, zeros of both signs; folds: one component 0, of both "
                   "signs, or up to 1e-4 beside it"};
    return table;
}

/// The largest error of GGX's peak for any roughness within half a step of `roughness`.
[[nodiscard]] inline double worst_peak_error(double roughness, std::uint32_t bits) {
    const double half_step = 0.5 / static_cast<double>((1u << bits) - 1u);
    double worst = 0;
    constexpr int parts = 2000;
    for (int i = -parts; i <= parts; ++i) {
        const double r = roughness + half_step * i / parts;
        worst = std::max(worst, peak_error(r, through_unorm(r, bits)));
    }
    return worst;
}

inline constexpr std::array<std::uint32_t, 4> roughness_bits = {8, 10, 12, 16};

[[nodiscard]] inline SpeedErrorTable roughness_errors(bool quick) {
    SpeedErrorTable table{.stem = "encodings: roughness and metallic",
                          .baseline = "cheapest",
                          .error = "roughness: peak of GGX's D, relative, over roughness 0.02 … 1; metallic: absolute"};
    const int count = quick ? 20000 : 1000000;
    for (const std::uint32_t bits : roughness_bits) {
        ErrorSample ramp;
        for (int i = 0; i <= count; ++i) {
            const double r = 0.02 + 0.98 * i / count;
            ramp.add(peak_error(r, through_unorm(r, bits)));
        }
        const std::string name = "unorm " + std::to_string(bits);
        std::vector<NamedNumber> more;
        for (const double r : {0.02, 0.045, 0.1, 0.2})
            more.push_back({"at " + significant(r, r == 0.045 ? 2 : 1) + ", max", worst_peak_error(r, bits)});
        table.rows.push_back(error_row("roughness", name.c_str(), ramp, bits / 8.0, std::move(more)));
    }
    ErrorSample metallic;
    for (int i = 0; i <= count; ++i) {
        const double m = static_cast<double>(i) / count;
        metallic.add(through_unorm(m, 8) - m);
    }
    table.rows.push_back(error_row("metallic", "unorm 8", metallic, 1, {}));
    table.notes = {"\"at r\": any roughness within half a step of r; the peak is 1/(π r⁴)"};
    return table;
}

[[nodiscard]] inline SpeedErrorTable color_errors(bool quick) {
    SpeedErrorTable table{
        .stem = "encodings: base colour", .baseline = "cheapest", .error = "linear light in [0,1], absolute"};
    const int count = quick ? 20000 : 1000000;
    for (const ColorEncoding& encoding : color_encodings) {
        const auto through = [&](double linear) {
            return decode_color(encoding.form, encode_color(encoding.form, linear));
        };
        ErrorSample linear, signal;  // [1] and [1/255]
        double relative = 0;
        for (int i = 0; i <= count; ++i) {
            const double value = static_cast<double>(i) / count, back = through(value);
            linear.add(back - value);
            signal.add(255 * (reference::srgb_from_linear(back) - reference::srgb_from_linear(value)));
            if (value >= 0.01) relative = std::max(relative, std::abs(back - value) / value);
        }
        int changed = 0, furthest = 0;
        for (int code = 0; code < 256; ++code) {
            const double value = reference::linear_from_srgb8(static_cast<std::uint8_t>(code));
            const int off = std::abs(reference::srgb8_from_linear(through(value)) - code);
            changed += off != 0;
            furthest = std::max(furthest, off);
        }
        table.rows.push_back(error_row("base colour", encoding.name, linear, 3,
                                       {{"relative from 0.01 on, max", relative},
                                        {"sRGB signal, max [1/255]", max_of(signal)},
                                        {"texture codes of 256 changed", static_cast<double>(changed)},
                                        {"by up to", static_cast<double>(furthest)}}));
    }
    table.notes = {"uniform in linear light; texture codes: sRGB bytes that are stored, read and encoded again"};
    return table;
}

/// Relative errors |Δp|/|p| of points that are seen through pixel centres, from near = 0.1 m to `far_over_near` times
/// that, uniform in the logarithm; the camera looks anywhere, `offset` [m] away from the origin in any direction.
[[nodiscard]] inline ErrorSample position_errors_at(const PositionEncoding& encoding, double far_over_near,
                                                    double offset, int count) {
    constexpr Extent2D size{1920, 1080};
    constexpr double near = 0.1;
    EncodingRandom random(2);
    ErrorSample out;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 eye = random.direction() * offset;
        const Camera camera{.near = near, .world_from_view = look_at(eye, eye + random.direction())};
        const PositionView view(camera, size, encoding.range, near * far_over_near);
        const auto x = static_cast<std::uint32_t>(random.uniform(0, size.width));
        const auto y = static_cast<std::uint32_t>(random.uniform(0, size.height));
        const glm::dvec2 ndc = reference::ndc_from_pixel<double>(x, y, size);
        const double distance = near * std::exp(random.uniform(0, std::log(far_over_near)));
        const glm::dvec3 on_ray(ndc.x * distance / view.clip.sx, ndc.y * distance / view.clip.sy, -distance);
        // The scene holds world coordinates in double; the eye is subtracted there.
        const glm::dmat3 turn(camera.world_from_view);
        const glm::dvec3 point = glm::transpose(turn) * (eye + turn * on_ray - eye);
        const glm::dvec3 back = through_position(encoding, view, reference::ndc_from_pixel<float>(x, y, size), point);
        out.add(glm::length(back - point) / glm::length(point));
    }
    return out;
}

[[nodiscard]] inline SpeedErrorTable position_errors(bool quick) {
    SpeedErrorTable table{.stem = "encodings: positions",
                          .baseline = "cheapest",
                          .error = "|Δp|/|p| from the eye, camera at the origin, far/near 1e4"};
    const int count = quick ? 5000 : 200000;
    for (const PositionEncoding& encoding : position_encodings) {
        std::vector<NamedNumber> more;
        ErrorSample middle;
        for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
            const ErrorSample sample = position_errors_at(encoding, ratio, 0, count);
            char name[32];
            std::snprintf(name, sizeof name, "far/near %.0e, max", ratio);
            more.push_back({name, max_of(sample)});
            if (ratio == 1e4) middle = sample;
        }
        more.push_back({"camera 1e5 m away, max", max_of(position_errors_at(encoding, 1e4, 1e5, count))});
        table.rows.push_back(error_row("positions", encoding.name, middle, encoding.bytes, std::move(more)));
    }
    table.notes = {
        "near 0.1 m, " + std::to_string(count) +
            " points uniform in log z for each number; vertices are placed in double and rounded to float "
            "once, depth and what is rebuilt from it are float; interpolation by the rasteriser is not in it",
        "depths have their bytes because a depth buffer is there anyway; stored positions come on top of it"};
    return table;
}

}  // namespace pellucid::bench
