// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the kernels of shaders/bench_encodings must find: the same values, through the same encodings, on the CPU.
#include <bench_encodings/parameters.h>
#include "encodings/errors.hpp"

namespace pellucid::bench {

static_assert(static_cast<std::uint32_t>(NormalForm::unorm_xyz) == NORMAL_UNORM_XYZ &&
              static_cast<std::uint32_t>(NormalForm::snorm_xyz) == NORMAL_SNORM_XYZ &&
              static_cast<std::uint32_t>(NormalForm::half_nearest) == NORMAL_HALF &&
              static_cast<std::uint32_t>(NormalForm::half_truncated) == NORMAL_HALF_TRUNCATED &&
              static_cast<std::uint32_t>(NormalForm::octahedral_snorm) == NORMAL_OCTAHEDRAL_SNORM &&
              static_cast<std::uint32_t>(NormalForm::octahedral_unorm) == NORMAL_OCTAHEDRAL_UNORM);
static_assert(static_cast<std::uint32_t>(ColorForm::srgb) == COLOR_SRGB &&
              static_cast<std::uint32_t>(ColorForm::linear) == COLOR_LINEAR &&
              static_cast<std::uint32_t>(ColorForm::gamma) == COLOR_GAMMA &&
              static_cast<std::uint32_t>(ColorForm::gamma_srgb) == COLOR_GAMMA_SRGB);
static_assert(static_cast<std::uint32_t>(PositionStore::world_float) == POSITION_WORLD_FLOAT &&
              static_cast<std::uint32_t>(PositionStore::world_half_nearest) == POSITION_WORLD_HALF &&
              static_cast<std::uint32_t>(PositionStore::world_half_truncated) == POSITION_WORLD_HALF_TRUNCATED &&
              static_cast<std::uint32_t>(PositionStore::depth24) == POSITION_DEPTH24 &&
              static_cast<std::uint32_t>(PositionStore::depth32f) == POSITION_DEPTH32F);
static_assert(static_cast<std::uint32_t>(PositionUse::relative) == POSITION_RELATIVE &&
              static_cast<std::uint32_t>(PositionUse::inverse_matrix) == POSITION_INVERSE_MATRIX &&
              static_cast<std::uint32_t>(PositionUse::added_to_the_camera) == POSITION_ADDED_TO_THE_CAMERA);

/// The sequence of values.glsl for one pixel.
class KernelValues {
public:
    KernelValues(PixelAt at, Extent2D size) : state_((at.y * size.width + at.x) * 0x9E3779B9u + 1u) {}
    float next() {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<float>(state_ >> 8u) * 0x1p-24f;
    }
    glm::vec3 next_vector() {
        const float x = next(), y = next(), z = next();
        return {x, y, z};
    }
    glm::vec3 next_direction() {
        const glm::vec3 v = next_vector() * 2.0f - 1.0f;
        return v / std::sqrt(std::max(glm::dot(v, v), 1e-12f));
    }
    /// Three halves of the words that `any_words` of normals.comp decodes.
    [[nodiscard]] NormalCode any_code(NormalForm form) const {
        const bool half = form == NormalForm::half_nearest || form == NormalForm::half_truncated;
        const std::uint32_t word = (half ? state_ & 0xBBFFBBFFu : state_) | 0x04000400u;
        const auto low = static_cast<std::uint16_t>(word), high = static_cast<std::uint16_t>(word >> 16u);
        return {low, high, high};
    }

private:
    std::uint32_t state_;
};

/// Root of the mean, and the largest, of the squared errors of some invocations.
struct KernelError {
    double rms = 0, max = 0;
};

/// `error_of(KernelValues&)` → |error| of the next value, for all values of all `pixels`.
template <class ErrorOf>
[[nodiscard]] KernelError kernel_error(const std::vector<PixelAt>& pixels, Extent2D size, ErrorOf error_of) {
    ErrorSample sample;
    for (const PixelAt at : pixels) {
        KernelValues values(at, size);
        for (int i = 0; i < BENCH_ENCODINGS_VALUES; ++i) sample.add(error_of(values));
    }
    return {sample.rms(), max_of(sample)};
}

[[nodiscard]] inline KernelError normal_kernel_error(const NormalEncoding& encoding, const std::vector<PixelAt>& pixels,
                                                     Extent2D size) {
    return kernel_error(pixels, size, [&](KernelValues& values) {
        const glm::vec3 n = values.next_direction();
        return double{glm::length(decode_normal(encoding, encode_normal(encoding, n)) - n)};
    });
}

/// What the decoder alone makes of any codes, against vectors that have nothing to do with them.
[[nodiscard]] inline KernelError decoder_kernel_error(const NormalEncoding& encoding,
                                                      const std::vector<PixelAt>& pixels, Extent2D size) {
    return kernel_error(pixels, size, [&](KernelValues& values) {
        const glm::vec3 n = values.next_direction();
        return double{glm::length(decode_normal(encoding, values.any_code(encoding.form)) - n)};
    });
}

/// The camera of the position kernels: at the origin, looking anywhere.
[[nodiscard]] inline Camera kernel_camera() {
    return {.near = BENCH_ENCODINGS_NEAR, .world_from_view = look_at({0, 0, 0}, {0.3, -0.2, 0.9}), .name = {}};
}
[[nodiscard]] inline PositionView kernel_view(DepthRange range, Extent2D size) {
    return {kernel_camera(), size, range, BENCH_ENCODINGS_NEAR * std::exp2(BENCH_ENCODINGS_OCTAVES)};
}

[[nodiscard]] inline KernelError position_kernel_error(const PositionEncoding& encoding,
                                                       const std::vector<PixelAt>& pixels, Extent2D size) {
    const PositionView view = kernel_view(encoding.range, size);
    return kernel_error(pixels, size, [&](KernelValues& values) {
        const glm::vec3 v = values.next_vector();
        const auto pixel = [](float share, std::uint32_t count) {
            return static_cast<std::uint32_t>(share * static_cast<float>(count));
        };
        const glm::vec2 ndc = reference::ndc_from_pixel<float>(pixel(v.x, size.width), pixel(v.y, size.height), size);
        const double distance = BENCH_ENCODINGS_NEAR * std::exp2(double{v.z} * BENCH_ENCODINGS_OCTAVES);
        const glm::dvec3 point(ndc.x * distance / view.clip.sx, ndc.y * distance / view.clip.sy, -distance);
        return glm::length(through_position(encoding, view, ndc, point) - point) / glm::length(point);
    });
}

[[nodiscard]] inline KernelError unorm_kernel_error(std::uint32_t bits, const std::vector<PixelAt>& pixels,
                                                    Extent2D size) {
    return kernel_error(pixels, size, [&](KernelValues& values) {
        const double v = values.next();
        return through_unorm(v, bits) - v;
    });
}

/// The mean is over colours, of the three squares' sum; the largest error is that of a channel.
[[nodiscard]] inline KernelError color_kernel_error(ColorForm form, const std::vector<PixelAt>& pixels, Extent2D size) {
    double largest = 0;
    KernelError out = kernel_error(pixels, size, [&](KernelValues& values) {
        const glm::vec3 c = values.next_vector();
        double squares = 0;
        for (int k = 0; k < 3; ++k) {
            const double off = decode_color(form, encode_color(form, c[k])) - c[k];
            squares += off * off;
            largest = std::max(largest, std::abs(off));
        }
        return std::sqrt(squares);
    });
    out.max = largest;
    return out;
}

}  // namespace pellucid::bench
