// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Texture filtering as Vulkan documents it ("Texel Filtering" and "Image Operations" of its specification, which are
/// OpenGL's rules too), in double and without the eight bits that GPUs keep of a fraction.  Texels are decoded exactly,
/// sRGB ones to linear light by IEC 61966-2-1, and then averaged.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <pellucid/core/image.hpp>
#include <pellucid/reference/srgb.hpp>
#include <pellucid/scene/material.hpp>
#include <pellucid/scene/mipmap.hpp>
#include <vector>

namespace pellucid::inline v0_1::reference {

/// A picture as it is sampled: 8-bit RGBA levels, each half the size of the one before, and how to read them.
struct SampledTexture {
    std::vector<Image8> levels;  ///< level 0 first; at least one, and one alone where the sampler is not mipmapped
    TextureSampler sampler;
    bool srgb = false;  ///< red, green and blue are sRGB codes; alpha never is
};

/// The levels that the renderer uploads: `make_mipmaps` with colours weighted by alpha where they are sRGB.
/// Precondition: `image` is `[h, w, 4]` and not empty.
[[nodiscard]] inline SampledTexture sampled_texture(const Image8& image, const TextureSampler& sampler, bool srgb);

/// One texel in linear light, each channel in [0,1].  Precondition: it exists.
[[nodiscard]] inline glm::dvec4 decoded_texel(const SampledTexture& texture, std::size_t level, std::uint32_t x,
                                              std::uint32_t y) noexcept;

/// The index in [0, count) that stands for texel `i` of a side: i mod count; i mod 2 count, its second half backwards;
/// or the nearest one.  Precondition: |i| < 2^62.
[[nodiscard]] constexpr std::uint32_t wrapped(std::int64_t i, std::uint32_t count, TextureWrap wrap) noexcept;

/// log2 ρ, ρ the larger length of the two derivatives in texels of level 0 a pixel.  −∞ for none (magnified), +∞
/// where a derivative is not finite.  `dx` and `dy`: change of (u, v) from pixel to pixel along x and y.
[[nodiscard]] inline double level_of_detail(Extent2D size, glm::dvec2 dx, glm::dvec2 dy) noexcept;

/// One level with one filter at (u, v), (0, 0) being the outer corner of the first texel.  Finite for any finite (u,
/// v).
[[nodiscard]] inline glm::dvec4 sample_level(const SampledTexture& texture, std::size_t level, glm::dvec2 uv,
                                             TextureFilter filter) noexcept;

/// The texture at (u, v) for a level of detail λ, which may be infinite: `mag` at level 0 for λ <= 0, else `min`; λ is
/// then limited to the levels there are, and rounded (half down) or blended between the two levels around it.
[[nodiscard]] inline glm::dvec4 sample(const SampledTexture& texture, glm::dvec2 uv, double lambda) noexcept;

/// The same with the level of detail that the derivatives ask for.
[[nodiscard]] inline glm::dvec4 sample(const SampledTexture& texture, glm::dvec2 uv, glm::dvec2 dx,
                                       glm::dvec2 dy) noexcept {
    const Extent2D size{texture.levels[0].width, texture.levels[0].height};
    return sample(texture, uv, level_of_detail(size, dx, dy));
}

// ---------------------------------------------------------------------------------------------------- bodies

SampledTexture sampled_texture(const Image8& image, const TextureSampler& sampler, bool srgb) {
    SampledTexture texture{.levels = {}, .sampler = sampler, .srgb = srgb};
    if (sampler.mipmapped)
        texture.levels = make_mipmaps(image, srgb ? MipContent::color_with_alpha : MipContent::data);
    else
        texture.levels.push_back(image);
    return texture;
}

glm::dvec4 decoded_texel(const SampledTexture& texture, std::size_t level, std::uint32_t x, std::uint32_t y) noexcept {
    static const std::array<double, 256> linear = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = linear_from_srgb8<double>(static_cast<std::uint8_t>(i));
        return values;
    }();
    const std::uint8_t* codes = texture.levels[level].texel(x, y);
    glm::dvec4 value;
    for (int c = 0; c < 4; ++c) value[c] = texture.srgb && c < 3 ? linear[codes[c]] : codes[c] / 255.0;
    return value;
}

constexpr std::uint32_t wrapped(std::int64_t i, std::uint32_t count, TextureWrap wrap) noexcept {
    const std::int64_t n = count;
    const auto modulo = [](std::int64_t a, std::int64_t b) { return (a % b + b) % b; };
    switch (wrap) {
        case TextureWrap::repeat:
            return static_cast<std::uint32_t>(modulo(i, n));
        case TextureWrap::mirror: {
            const std::int64_t m = modulo(i, 2 * n);
            return static_cast<std::uint32_t>(m < n ? m : 2 * n - 1 - m);
        }
        case TextureWrap::clamp:
            break;
    }
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
}

double level_of_detail(Extent2D size, glm::dvec2 dx, glm::dvec2 dy) noexcept {
    const auto texels = [&](glm::dvec2 d) { return std::hypot(d.x * size.width, d.y * size.height); };
    const double along_x = texels(dx), along_y = texels(dy);
    if (!std::isfinite(along_x) || !std::isfinite(along_y)) return std::numeric_limits<double>::infinity();
    return std::log2(std::max(along_x, along_y));
}

namespace detail {

/// Where a coordinate falls in texels of a side, brought near [0, count) first so that it has an integer's range.
[[nodiscard]] inline double texel_coordinate(double t, std::uint32_t count, TextureWrap wrap) noexcept {
    if (wrap == TextureWrap::clamp) return std::clamp(t, -1.0, 2.0) * count;
    const double period = wrap == TextureWrap::repeat ? 1.0 : 2.0;
    return (t - period * std::floor(t / period)) * count;
}

}  // namespace detail

glm::dvec4 sample_level(const SampledTexture& texture, std::size_t level, glm::dvec2 uv,
                        TextureFilter filter) noexcept {
    const Image8& image = texture.levels[level];
    const TextureSampler& s = texture.sampler;
    const double u = detail::texel_coordinate(uv.x, image.width, s.wrap_u);
    const double v = detail::texel_coordinate(uv.y, image.height, s.wrap_v);
    const auto texel = [&](double x, double y) {
        return decoded_texel(texture, level, wrapped(static_cast<std::int64_t>(x), image.width, s.wrap_u),
                             wrapped(static_cast<std::int64_t>(y), image.height, s.wrap_v));
    };
    if (filter == TextureFilter::nearest) return texel(std::floor(u), std::floor(v));
    const double x = std::floor(u - 0.5), y = std::floor(v - 0.5);
    const double right = u - 0.5 - x, below = v - 0.5 - y;  // shares in [0,1)
    return (texel(x, y) * (1 - right) + texel(x + 1, y) * right) * (1 - below) +
           (texel(x, y + 1) * (1 - right) + texel(x + 1, y + 1) * right) * below;
}

glm::dvec4 sample(const SampledTexture& texture, glm::dvec2 uv, double lambda) noexcept {
    const TextureSampler& s = texture.sampler;
    if (lambda <= 0) return sample_level(texture, 0, uv, s.mag);
    const double last = static_cast<double>(texture.levels.size() - 1);
    const double limited = std::min(lambda, last);
    if (s.mip == TextureFilter::nearest)
        return sample_level(texture, static_cast<std::size_t>(std::ceil(limited + 0.5) - 1), uv, s.min);
    const double level = std::floor(limited), share = limited - level;
    const glm::dvec4 fine = sample_level(texture, static_cast<std::size_t>(level), uv, s.min);
    if (share == 0) return fine;
    return fine * (1 - share) + sample_level(texture, static_cast<std::size_t>(level) + 1, uv, s.min) * share;
}

}  // namespace pellucid::inline v0_1::reference
