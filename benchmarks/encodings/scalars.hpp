// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The ways of storing numbers in [0,1]: roughness and metallic in unorms of some width, base colour in eight bits.
#include <algorithm>
#include <array>
#include <pellucid/reference/srgb.hpp>

namespace pellucid::bench {

/// A number in [0,1] that went through `bits` bits as the library rounds: to nearest, ties upward.  Outside: limited;
/// NaN: 0.  1 <= bits <= 24.
[[nodiscard]] inline double through_unorm(double value, std::uint32_t bits) noexcept {
    const auto limit = static_cast<double>((1u << bits) - 1u);
    const double inside = value > 0 ? std::min(value, 1.0) : 0.0;
    return std::floor(inside * limit + 0.5) / limit;
}

/// The peak of the GGX distribution is 1/(π α²) with α = r² (Walter et al. 2007; Burley 2012), so ∝ 1/r⁴: how far the
/// peak of `stored` is from that of `roughness`, relative.  Infinite where 0 was stored.
[[nodiscard]] inline double peak_error(double roughness, double stored) noexcept {
    const double ratio = roughness / stored, square = ratio * ratio;
    return std::abs(square * square - 1);
}

/// How linear light becomes the signal that is stored in a byte, and back.  The values are those of the shader's
/// constant.
enum class ColorForm : std::uint32_t {
    srgb = 1,        ///< IEC 61966-2-1, the library's
    linear = 2,      ///< as it is
    gamma = 3,       ///< power 1/2.2 and power 2.2
    gamma_srgb = 4,  ///< written with power 1/2.2, read as sRGB: a mistake that looks nearly right
};

struct ColorEncoding {
    const char* name;
    ColorForm form;
};
inline constexpr std::array<ColorEncoding, 4> color_encodings = {{{"linear 8", ColorForm::linear},
                                                                  {"gamma 2.2, 8", ColorForm::gamma},
                                                                  {"gamma 2.2 read as sRGB, 8", ColorForm::gamma_srgb},
                                                                  {"sRGB 8", ColorForm::srgb}}};

/// Linear light in [0,1] → byte.  Outside: limited; NaN: 0.
[[nodiscard]] inline std::uint8_t encode_color(ColorForm form, double linear) noexcept {
    switch (form) {
        case ColorForm::srgb:
            return reference::srgb8_from_linear(linear);
        case ColorForm::linear:
            return reference::unorm8(linear);
        case ColorForm::gamma:
        case ColorForm::gamma_srgb:
            break;
    }
    return linear > 0 ? reference::unorm8(std::pow(linear, 1 / 2.2)) : std::uint8_t{0};
}

[[nodiscard]] inline double decode_color(ColorForm form, std::uint8_t code) noexcept {
    switch (form) {
        case ColorForm::srgb:
        case ColorForm::gamma_srgb:
            return reference::linear_from_srgb8(code);
        case ColorForm::linear:
            return code / 255.0;
        case ColorForm::gamma:
            break;
    }
    return std::pow(code / 255.0, 2.2);
}

}  // namespace pellucid::bench
