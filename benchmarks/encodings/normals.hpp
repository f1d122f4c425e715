// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The ways of storing a unit vector that G-buffers use, in float arithmetic as a shader would: what is measured beside
/// the library's own 2 × snorm16 octahedral code with precise rounding, which is called from the library.
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <pellucid/reference/gbuffer.hpp>
#include "encodings/half_nearest.hpp"

namespace pellucid::bench {

/// What the codes of a vector are.  The values are those of the shader's constant (bench_encodings/parameters.h).
enum class NormalForm : std::uint32_t {
    unorm_xyz = 1,       ///< x, y, z in [−1,1] as [0,1] · (2^bits − 1): no code is 0
    snorm_xyz = 2,       ///< x, y, z · (2^(bits−1) − 1), signed
    half_nearest = 3,    ///< x, y, z as binary16, to nearest
    half_truncated = 4,  ///< the same toward zero, as GPUs store it
    octahedral_snorm = 5,
    octahedral_unorm = 6,
};

struct NormalEncoding {
    const char* name;
    NormalForm form;
    std::uint32_t bits;  ///< a component, 2 … 16; binary16: 16
    bool precise;        ///< octahedral_snorm: the nearest of the four codes around the point
    double bytes;        ///< a pixel: of the texture format, or of the codes' bits where no format has just as many
};

inline constexpr std::array<NormalEncoding, 16> normal_encodings = {{
    {"oct16", NormalForm::octahedral_snorm, 8, false, 2},
    {"oct16 precise", NormalForm::octahedral_snorm, 8, true, 2},
    {"oct20", NormalForm::octahedral_snorm, 10, false, 2.5},
    {"oct20 precise", NormalForm::octahedral_snorm, 10, true, 2.5},
    {"oct22", NormalForm::octahedral_snorm, 11, false, 2.75},
    {"oct22 precise", NormalForm::octahedral_snorm, 11, true, 2.75},
    {"RGB8 unorm", NormalForm::unorm_xyz, 8, false, 3},
    {"oct24", NormalForm::octahedral_snorm, 12, false, 3},
    {"oct24 unorm", NormalForm::octahedral_unorm, 12, false, 3},
    {"oct24 precise", NormalForm::octahedral_snorm, 12, true, 3},
    {"RGB10A2 unorm", NormalForm::unorm_xyz, 10, false, 4},
    {"oct32", NormalForm::octahedral_snorm, 16, false, 4},
    {"oct32 precise", NormalForm::octahedral_snorm, 16, true, 4},
    {"RGBA16F, toward zero", NormalForm::half_truncated, 16, false, 8},
    {"RGBA16F, nearest", NormalForm::half_nearest, 16, false, 8},
    {"RGBA16 snorm", NormalForm::snorm_xyz, 16, false, 8},
}};

/// Whether the encoding is the one that the library's `compact` layout has.
[[nodiscard]] constexpr bool is_of_the_library(const NormalEncoding& e) noexcept {
    return e.form == NormalForm::octahedral_snorm && e.bits == 16 && e.precise;
}

/// Codes of x, y, z, or of the two octahedral coordinates; signed ones are extended to 16 bits.
using NormalCode = std::array<std::uint16_t, 3>;

/// Zero, infinite and NaN vectors give the code of +z, as the library does.
[[nodiscard]] NormalCode encode_normal(const NormalEncoding& encoding, glm::vec3 direction) noexcept;

/// A unit vector to float precision.  Precondition: `code` is one of `encode_normal`.
[[nodiscard]] glm::vec3 decode_normal(const NormalEncoding& encoding, const NormalCode& code) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

namespace detail {

/// [−1,1] → signed code, to nearest, ties upward; and back.
[[nodiscard]] inline float snorm_limit(std::uint32_t bits) noexcept {
    return static_cast<float>((1u << (bits - 1)) - 1u);
}
[[nodiscard]] inline std::uint16_t code_of(float whole) noexcept {
    return static_cast<std::uint16_t>(static_cast<std::int32_t>(whole));
}
[[nodiscard]] inline std::uint16_t snorm_code(float value, std::uint32_t bits) noexcept {
    const float limit = snorm_limit(bits);
    return code_of(std::clamp(std::floor(value * limit + 0.5f), -limit, limit));
}
[[nodiscard]] inline float snorm_value(std::uint16_t code, std::uint32_t bits) noexcept {
    return static_cast<float>(static_cast<std::int16_t>(code)) / snorm_limit(bits);
}
[[nodiscard]] inline std::uint16_t signed_unorm_code(float value, std::uint32_t bits) noexcept {
    const auto limit = static_cast<float>((1u << bits) - 1u);
    return static_cast<std::uint16_t>(std::clamp(std::floor((value * 0.5f + 0.5f) * limit + 0.5f), 0.0f, limit));
}
[[nodiscard]] inline float signed_unorm_value(std::uint16_t code, std::uint32_t bits) noexcept {
    return static_cast<float>(code) / static_cast<float>((1u << bits) - 1u) * 2.0f - 1.0f;
}

/// Precise rounding for any number of bits (Cigolle et al. 2014): of the four codes around the point the one whose
/// direction is nearest.
[[nodiscard]] inline NormalCode nearest_octahedral(glm::vec3 direction, std::uint32_t bits) noexcept {
    const float limit = snorm_limit(bits);
    const glm::vec2 exact = reference::octahedron_from_direction(direction) * limit;
    const glm::vec2 low(std::floor(exact.x), std::floor(exact.y));
    NormalCode best = {};
    float closest = 8.0f;
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 codes(std::clamp(low.x + static_cast<float>(i & 1), -limit, limit),
                              std::clamp(low.y + static_cast<float>(i >> 1), -limit, limit));
        const glm::vec3 off = reference::direction_from_octahedron(codes / limit) - direction;
        const float distance = glm::dot(off, off);
        if (distance < closest) {
            closest = distance;
            best = {code_of(codes.x), code_of(codes.y), 0};
        }
    }
    return best;
}

}  // namespace detail

inline NormalCode encode_normal(const NormalEncoding& encoding, glm::vec3 direction) noexcept {
    const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > 0.0f) || !std::isfinite(sum)) direction = {0, 0, 1};
    const std::uint32_t bits = encoding.bits;
    const auto each = [&](auto code) { return NormalCode{code(direction.x), code(direction.y), code(direction.z)}; };
    switch (encoding.form) {
        case NormalForm::unorm_xyz:
            return each([&](float v) { return detail::signed_unorm_code(v, bits); });
        case NormalForm::snorm_xyz:
            return each([&](float v) { return detail::snorm_code(v, bits); });
        case NormalForm::half_nearest:
            return each([](float v) { return half_nearest(v); });
        case NormalForm::half_truncated:
            return each([](float v) { return half_toward_zero(v); });
        case NormalForm::octahedral_snorm:
        case NormalForm::octahedral_unorm:
            break;
    }
    if (is_of_the_library(encoding)) {
        const std::uint32_t code = reference::oct32_from_direction(direction);
        return {static_cast<std::uint16_t>(code), static_cast<std::uint16_t>(code >> 16u), 0};
    }
    if (encoding.precise) return detail::nearest_octahedral(direction, bits);
    const glm::vec2 p = reference::octahedron_from_direction(direction);
    if (encoding.form == NormalForm::octahedral_unorm)
        return {detail::signed_unorm_code(p.x, bits), detail::signed_unorm_code(p.y, bits), 0};
    return {detail::snorm_code(p.x, bits), detail::snorm_code(p.y, bits), 0};
}

inline glm::vec3 decode_normal(const NormalEncoding& encoding, const NormalCode& code) noexcept {
    const std::uint32_t bits = encoding.bits;
    const auto each = [&](auto value) { return glm::vec3(value(code[0]), value(code[1]), value(code[2])); };
    const auto unit = [](glm::vec3 v) { return v / std::sqrt(glm::dot(v, v)); };
    switch (encoding.form) {
        case NormalForm::unorm_xyz:
            return unit(each([&](std::uint16_t c) { return detail::signed_unorm_value(c, bits); }));
        case NormalForm::snorm_xyz:
            return unit(each([&](std::uint16_t c) { return detail::snorm_value(c, bits); }));
        case NormalForm::half_nearest:
        case NormalForm::half_truncated:
            return unit(each([](std::uint16_t c) { return half_to_float(c); }));
        case NormalForm::octahedral_snorm:
            if (is_of_the_library(encoding))
                return reference::direction_from_oct32<float>(std::uint32_t{code[0]} | std::uint32_t{code[1]} << 16u);
            return reference::direction_from_octahedron(
                glm::vec2(detail::snorm_value(code[0], bits), detail::snorm_value(code[1], bits)));
        case NormalForm::octahedral_unorm:
            break;
    }
    return reference::direction_from_octahedron(
        glm::vec2(detail::signed_unorm_value(code[0], bits), detail::signed_unorm_value(code[1], bits)));
}

}  // namespace pellucid::bench
