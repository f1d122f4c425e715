// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Texel formats: only those that both APIs must support as this library uses them.
#include <cstddef>
#include <cstdint>

namespace pellucid::inline v0_1::rhi {

/// Texel formats that both APIs have.
enum class Format : std::uint8_t {
    undefined,
    r8_unorm,
    rgba8_unorm,
    rgba8_srgb,
    r32_uint,
    rg32_uint,
    rgba32_uint,
    r16_float,
    rg16_float,
    rgba16_float,
    r32_float,
    rg32_float,
    rgba32_float,
    d32_float,
    d32_float_s8_uint,
    count
};

/// What a sampler or an attachment sees of a format.
enum class NumericKind : std::uint8_t { none, unorm, srgb, uint, floating, depth };

/// What a format is made of.
struct FormatInfo {
    const char* name = "";
    std::uint32_t bytes = 0;     ///< a texel, depth aspect only for depth-stencil
    std::uint32_t channels = 0;  ///< colour channels; 1 for depth
    NumericKind kind = NumericKind::none;
    bool depth = false;
    bool stencil = false;
    bool storage = false;    ///< may be an image of a shader (load and store)
    bool blendable = false;  ///< may be blended into as a colour attachment
};

namespace detail {
using enum NumericKind;
inline constexpr FormatInfo format_table[] = {
    {"undefined", 0, 0, none, false, false, false, false},
    {"r8_unorm", 1, 1, unorm, false, false, false, true},
    {"rgba8_unorm", 4, 4, unorm, false, false, true, true},
    {"rgba8_srgb", 4, 4, srgb, false, false, false, true},
    {"r32_uint", 4, 1, uint, false, false, true, false},
    {"rg32_uint", 8, 2, uint, false, false, true, false},
    {"rgba32_uint", 16, 4, uint, false, false, true, false},
    {"r16_float", 2, 1, floating, false, false, false, true},
    {"rg16_float", 4, 2, floating, false, false, false, true},
    {"rgba16_float", 8, 4, floating, false, false, true, true},
    {"r32_float", 4, 1, floating, false, false, true, true},
    {"rg32_float", 8, 2, floating, false, false, true, true},
    {"rgba32_float", 16, 4, floating, false, false, true, true},
    {"d32_float", 4, 1, NumericKind::depth, true, false, false, false},
    {"d32_float_s8_uint", 4, 1, NumericKind::depth, true, true, false, false},
};
static_assert(sizeof format_table / sizeof format_table[0] == static_cast<std::size_t>(Format::count));
}  // namespace detail

/// What `format` is made of.
[[nodiscard]] constexpr const FormatInfo& info(Format format) noexcept {
    return detail::format_table[static_cast<std::size_t>(format)];
}

}  // namespace pellucid::inline v0_1::rhi
