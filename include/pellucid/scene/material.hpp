// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// glTF 2.0 metallic-roughness materials and the pictures they sample.  CPU data; no RHI types.
#include <pellucid/core/image.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <cstdint>
#include <string>

namespace pellucid::inline v0_1 {

/// What alpha means: nothing, a hole below the cutoff, or coverage.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };
/// Between texels, or the nearest.
enum class TextureFilter : std::uint8_t { nearest, linear };
/// What is beyond the border of a texture.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };

/// How a texture is sampled, as glTF has it.
struct TextureSampler {
    TextureFilter min = TextureFilter::linear;
    TextureFilter mag = TextureFilter::linear;
    TextureFilter mip = TextureFilter::linear;
    bool mipmapped = true;
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    friend bool operator==(const TextureSampler&, const TextureSampler&) = default;
};

inline constexpr std::uint32_t no_index = ~0u;

/// Use of a texture by a material: which one, which texture coordinates, and KHR_texture_transform.
struct TextureRef {
    std::uint32_t texture = no_index;  ///< index into Scene::textures, or no_index
    std::uint32_t uv_set = 0;          ///< 0 or 1
    glm::vec2 offset{0, 0};
    glm::vec2 scale{1, 1};
    float rotation = 0;  ///< [rad] counter-clockwise, in texture space (KHR_texture_transform)
    [[nodiscard]] bool used() const noexcept { return texture != no_index; }
};

/// A metallic-roughness material of glTF 2.0.
struct Material {
    glm::vec4 base_color{1, 1, 1, 1};  ///< linear, straight alpha, each in [0,1]
    float metallic = 1;                ///< [0,1]
    float roughness = 1;               ///< [0,1] perceptual; alpha of GGX is its square
    glm::vec3 emissive{0, 0, 0};       ///< [cd/m²] linear, strength of KHR_materials_emissive_strength included
    float normal_scale = 1;
    float occlusion_strength = 1;  ///< [0,1]
    float alpha_cutoff = 0.5f;     ///< for AlphaMode::mask
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    bool unlit = false;  ///< KHR_materials_unlit
    /// AlphaMode::blend: radiance is already multiplied by alpha, as fire and glows are drawn: with alpha 0 it is
    /// added. glTF cannot say it.
    bool premultiplied = false;
    TextureRef base_color_texture = {};          ///< sRGB colour, linear alpha
    TextureRef metallic_roughness_texture = {};  ///< linear: g roughness, b metallic
    TextureRef normal_texture = {};              ///< linear: tangent-space normal, [0,1] → [-1,1]
    TextureRef occlusion_texture = {};           ///< linear: r
    TextureRef emissive_texture = {};            ///< sRGB
    std::string name = {};
};

/// A picture and how it is sampled.
struct SceneTexture {
    std::uint32_t image = no_index;  ///< index into Scene::images
    TextureSampler sampler = {};
};

/// 8-bit RGBA pictures, row 0 at the top; whether the texels are sRGB or linear follows from their use.
struct SceneImage {
    Image8 pixels = {};  ///< [h, w, 4]
    std::string name = {};
};

}  // namespace pellucid::inline v0_1
