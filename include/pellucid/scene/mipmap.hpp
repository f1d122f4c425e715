// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Mip chains on the CPU, the same bits on every machine and for every backend.
#include <pellucid/core/config.hpp>
#include <pellucid/core/image.hpp>
#include <cstdint>
#include <vector>

namespace pellucid::inline v0_1 {

/// What the texels mean, and so how they are averaged.
enum class MipContent : std::uint8_t {
    data,             ///< every channel linear and on its own: normals (not renormalised), roughness, occlusion
    color,            ///< sRGB colour averaged in linear light, alpha linear and on its own
    color_with_alpha  ///< the same, each texel's colour weighted by its alpha, so that the colour of texels that do not
                      ///< show does not bleed in; where no alpha is left, colours are averaged evenly
};

/// Number of levels down to 1 x 1: floor(log2(longer side)) + 1; 0 for an empty size.
[[nodiscard]] std::uint32_t mip_count(Extent2D size);

/// The full chain of `[h, w, 4]`: level 0 is `image` itself, each next one has half the size, rounded down, at least 1.
/// Every texel is the mean over exactly the area that it covers in the level above: two texels by two where sizes are
/// even, three with the weights of their overlap where they are odd (n = 2m + 1: (m - i)/n, m/n, (i + 1)/n for texel i
/// of m).  Levels are kept in float between steps and rounded to 8 bits once.
/// Precondition: 4 channels, not empty.
[[nodiscard]] std::vector<Image8> make_mipmaps(const Image8& image, MipContent content);

/// IEC 61966-2-1: the linear value in [0,1] of an 8-bit sRGB code.
[[nodiscard]] float linear_from_srgb(std::uint8_t code);

/// The nearest 8-bit sRGB code of a linear value, clamped to [0,1] (NaN: 0); inverse of `linear_from_srgb` for all
/// codes.
[[nodiscard]] std::uint8_t srgb_from_linear(double linear);

}  // namespace pellucid::inline v0_1

#ifdef PELLUCID_HEADER_ONLY
#include <pellucid/scene/mipmap-inl.hpp>
#endif
