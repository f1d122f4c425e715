// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Tone mapping: linear scene radiance → linear display colour in [0,1] (Rec. 709 primaries).  The sRGB curve
/// (reference/srgb.hpp, or the attachment's format) comes after it.
///
/// Every operator takes any input: NaN and negative channels count as 0, channels above 65504 (also +infinity) as
/// 65504, before the exposure multiplies them.  So no operator returns NaN, and each is monotone in exposure on grey.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace pellucid::inline v0_1::reference {

/// `none`: limited to [0,1].
/// `reinhard`: x/(1+x) on each channel (Reinhard et al. 2002, without the white point).
/// `neutral`: Khronos PBR Neutral (its published specification); keeps hue, and base colours up to 0.76 − 0.04.
/// `aces`: Narkowicz's 2015 rational fit of the ACES curve on each channel, without his optional 0.6 of exposure.
/// `agx`: Sobotka's AgX as commonly implemented: inset matrix, log2 over 16.5 stops, Wrensch's sixth-degree fit of the
///        base sigmoid, outset matrix, and the 2.2 power that makes the result linear again; no "look".
enum class ToneMap : std::uint8_t { none, reinhard, neutral, aces, agx };

inline constexpr double max_scene_value = 65504;  ///< largest finite binary16, what an RGBA16F target can hold

/// Limits each channel to [0, 65504]; NaN becomes 0.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> sanitized(glm::vec<3, T> color) noexcept;

/// `sanitized(color)` times 2^ev, the operator, and the limit [0,1].  `ev` in [−32, 32].
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> tone_map(ToneMap operation, T ev, glm::vec<3, T> color) noexcept;

// The operators alone.  Precondition: every channel is finite and >= 0.  `aces` and `agx` may leave [0,1] a little.

template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> tone_map_reinhard(glm::vec<3, T> color) noexcept;

/// With x the least channel, offset = x − 6.25x² below 0.08, else 0.04; c = color − offset; peak p = the largest of c.
/// p < 0.76: c.  Else p' = 1 − 0.24²/(p + 0.24 − 0.76), c p'/p mixed with p' by 1 − 1/(0.15(p − p') + 1).
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> tone_map_neutral(glm::vec<3, T> color) noexcept;

/// The exact inverse of `tone_map_neutral`, in closed form, for colours it can give: channels in [0,1), largest < 1.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> inverse_tone_map_neutral(glm::vec<3, T> mapped) noexcept;

/// x(2.51x + 0.03)/(x(2.43x + 0.59) + 0.14); reaches 1 near x = 7.2 and 1.033 at infinity.
template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> tone_map_aces(glm::vec<3, T> color) noexcept;

template <std::floating_point T>
[[nodiscard]] glm::vec<3, T> tone_map_agx(glm::vec<3, T> color) noexcept;

// ---------------------------------------------------------------------------------------------------- bodies

template <std::floating_point T>
glm::vec<3, T> sanitized(glm::vec<3, T> color) noexcept {
    for (int i = 0; i < 3; ++i) color[i] = color[i] > T(0) ? std::min(color[i], T(max_scene_value)) : T(0);
    return color;
}

/// x/(1 + x) on each channel.
template <std::floating_point T>
glm::vec<3, T> tone_map_reinhard(glm::vec<3, T> color) noexcept {
    return color / (color + glm::vec<3, T>(T(1)));
}

namespace neutral {
inline constexpr double compression_start = 0.76;  // 0.8 − the 0.04 that F0 of a dielectric adds
inline constexpr double compression_range = 0.24;  // 1 − start
inline constexpr double desaturation = 0.15;
}  // namespace neutral

template <std::floating_point T>
glm::vec<3, T> tone_map_neutral(glm::vec<3, T> color) noexcept {
    constexpr T start = T(neutral::compression_start), range = T(neutral::compression_range);
    const T least = std::min({color.x, color.y, color.z});
    const T offset = least < T(0.08) ? least - T(6.25) * least * least : T(0.04);
    const glm::vec<3, T> shifted = color - glm::vec<3, T>(offset);
    const T peak = std::max({shifted.x, shifted.y, shifted.z});
    if (peak < start) return shifted;
    const T new_peak = T(1) - range * range / (peak + range - start);
    const T keep = T(1) / (T(neutral::desaturation) * (peak - new_peak) + T(1));
    return shifted * (new_peak / peak * keep) + glm::vec<3, T>(new_peak * (T(1) - keep));
}

template <std::floating_point T>
glm::vec<3, T> inverse_tone_map_neutral(glm::vec<3, T> mapped) noexcept {
    constexpr T start = T(neutral::compression_start), range = T(neutral::compression_range);
    const T new_peak = std::max({mapped.x, mapped.y, mapped.z});
    glm::vec<3, T> shifted = mapped;
    if (new_peak >= start) {
        const T peak = range * range / (T(1) - new_peak) - range + start;
        const T spread = T(neutral::desaturation) * (peak - new_peak) + T(1);  // 1/keep
        const glm::vec<3, T> unmixed = (mapped - glm::vec<3, T>(new_peak)) * spread + glm::vec<3, T>(new_peak);
        shifted = unmixed * (peak / new_peak);
    }
    // least' = 6.25 least² below 0.08, where it reaches 0.04
    const T least = std::max(std::min({shifted.x, shifted.y, shifted.z}), T(0));
    const T offset = least < T(0.04) ? std::sqrt(least / T(6.25)) - least : T(0.04);
    return shifted + glm::vec<3, T>(offset);
}

template <std::floating_point T>
glm::vec<3, T> tone_map_aces(glm::vec<3, T> x) noexcept {
    return x * (T(2.51) * x + T(0.03)) / (x * (T(2.43) * x + T(0.59)) + T(0.14));
}

/// AgX, to linear colour.
template <std::floating_point T>
glm::vec<3, T> tone_map_agx(glm::vec<3, T> color) noexcept {
    using Vector = glm::vec<3, T>;
    using Matrix = glm::mat<3, 3, T>;  // columns
    const Matrix inset(Vector(T(0.842479062253094), T(0.0423282422610123), T(0.0423756549057051)),
                       Vector(T(0.0784335999999992), T(0.878468636469772), T(0.0784336)),
                       Vector(T(0.0792237451477643), T(0.0791661274605434), T(0.879142973793104)));
    const Matrix outset(Vector(T(1.19687900512017), T(-0.0528968517574562), T(-0.0529716355144438)),
                        Vector(T(-0.0980208811401368), T(1.15190312990417), T(-0.0980434501171241)),
                        Vector(T(-0.0990297440797205), T(-0.0989611768448433), T(1.15107367264116)));
    constexpr T lowest = T(-12.47393), highest = T(4.026069);  // [stops] around 1: 0.18 · 2^−10 … 0.18 · 2^6.5
    Vector v = inset * color;
    for (int i = 0; i < 3; ++i) {
        const T stops = std::clamp(std::log2(std::max(v[i], T(1e-10))), lowest, highest);
        const T x = (stops - lowest) / (highest - lowest);
        v[i] = (((((T(15.5) * x - T(40.14)) * x + T(31.96)) * x - T(6.868)) * x + T(0.4298)) * x + T(0.1191)) * x -
               T(0.00232);
    }
    v = outset * v;
    for (int i = 0; i < 3; ++i) v[i] = std::pow(std::max(v[i], T(0)), T(2.2));
    return v;
}

template <std::floating_point T>
glm::vec<3, T> tone_map(ToneMap operation, T ev, glm::vec<3, T> color) noexcept {
    glm::vec<3, T> mapped = sanitized(color) * std::exp2(ev);
    switch (operation) {
        case ToneMap::none:
            break;
        case ToneMap::reinhard:
            mapped = tone_map_reinhard(mapped);
            break;
        case ToneMap::neutral:
            mapped = tone_map_neutral(mapped);
            break;
        case ToneMap::aces:
            mapped = tone_map_aces(mapped);
            break;
        case ToneMap::agx:
            mapped = tone_map_agx(mapped);
            break;
    }
    for (int i = 0; i < 3; ++i) mapped[i] = std::min(mapped[i], T(1));
    return mapped;
}

}  // namespace pellucid::inline v0_1::reference
