// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Gathers a scene's textures in a bounded number of arrays, so that one set of bindings serves every draw and every
/// compute pass without descriptor indexing.
#include <pellucid/core/image.hpp>
#include <pellucid/scene/scene.hpp>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace pellucid::inline v0_1 {

/// One array: pictures of one size, encoding and sampler.
struct TextureArrayPlan {
    Extent2D size = {};
    bool srgb = false;
    TextureSampler sampler = {};
    std::vector<std::uint32_t> images;  ///< image of each layer
};

/// Which arrays the textures of a scene are in, and where.
struct TexturePlan {
    /// Where a texture lies when it is read as colour (sRGB) or as data (linear).
    struct Place {
        std::uint32_t array = no_index;
        std::uint32_t layer = 0;
    };
    std::vector<TextureArrayPlan> arrays;
    std::vector<Place> as_color;        ///< for each of Scene::textures
    std::vector<Place> as_data;         ///< for each of Scene::textures
    std::vector<std::string> warnings;  ///< a sentence for every picture that had to be resized or re-sampled
};

/// Plans at most `max_arrays` (>= 2) arrays of at most `max_layers` layers.  Where a scene has more kinds (size ×
/// encoding × sampler) than that, kinds are merged, most alike first, and each merge is a warning: pictures are then
/// enlarged to the larger size of the two, or lose their own sampler.  Layers stay within the limit while any merge
/// allows it; what fits in no way at all becomes the error of the texture's creation.
[[nodiscard]] TexturePlan plan_textures(const Scene& scene, std::uint32_t max_arrays, std::uint32_t max_layers = 2048);

// ------------------------------------------------------------------------------------------------------- body

namespace detail {

/// What is lost by merging two arrays, most severe first: a device's limit, a sampler, memory.
inline std::uint32_t merge_cost(const TextureArrayPlan& a, const TextureArrayPlan& b, std::uint32_t max_layers) {
    if (a.srgb != b.srgb) return ~0u;
    const std::uint32_t layers = a.images.size() + b.images.size() > max_layers ? 0x80000000u : 0u;
    const std::uint32_t sampler = a.sampler == b.sampler ? 0u : 0x40000000u;
    const auto area = [](std::uint32_t w, std::uint32_t h) { return std::uint64_t{w} * h; };
    const std::uint64_t grown = area(std::max(a.size.width, b.size.width), std::max(a.size.height, b.size.height));
    const std::uint64_t waste = grown * (a.images.size() + b.images.size()) -
                                area(a.size.width, a.size.height) * a.images.size() -
                                area(b.size.width, b.size.height) * b.images.size();
    return layers | sampler | static_cast<std::uint32_t>(std::min<std::uint64_t>(waste >> 8u, 0x3FFFFFFEu));
}

}  // namespace detail

inline TexturePlan plan_textures(const Scene& scene, std::uint32_t max_arrays, std::uint32_t max_layers) {
    TexturePlan plan;
    plan.as_color.resize(scene.textures.size());
    plan.as_data.resize(scene.textures.size());
    struct Wanted {
        std::uint32_t texture;
        bool srgb;
    };
    std::vector<Wanted> wanted;
    auto want = [&](const TextureRef& ref, bool srgb) {
        if (!ref.used() || scene.textures[ref.texture].image == no_index) return;
        wanted.push_back({ref.texture, srgb});
    };
    for (const Material& m : scene.materials) {
        want(m.base_color_texture, true);
        want(m.metallic_roughness_texture, false);
        want(m.normal_texture, false);
        want(m.occlusion_texture, false);
        want(m.emissive_texture, true);
    }
    auto contains = [](const TextureArrayPlan& array, std::uint32_t image) {
        return std::find(array.images.begin(), array.images.end(), image) != array.images.end();
    };
    for (const Wanted& w : wanted) {
        const SceneTexture& texture = scene.textures[w.texture];
        const Image8& pixels = scene.images[texture.image].pixels;
        const Extent2D size{pixels.width, pixels.height};
        auto fits = [&](const TextureArrayPlan& array) {
            return array.size == size && array.srgb == w.srgb && array.sampler == texture.sampler &&
                   (contains(array, texture.image) || array.images.size() < max_layers);
        };
        auto found = std::find_if(plan.arrays.begin(), plan.arrays.end(), fits);
        if (found == plan.arrays.end())
            found = plan.arrays.insert(plan.arrays.end(),
                                       {.size = size, .srgb = w.srgb, .sampler = texture.sampler, .images = {}});
        if (!contains(*found, texture.image)) found->images.push_back(texture.image);
    }
    while (plan.arrays.size() > max_arrays) {
        std::size_t best_a = 0, best_b = 0;
        std::uint32_t best = ~0u;
        for (std::size_t a = 0; a < plan.arrays.size(); ++a)
            for (std::size_t b = a + 1; b < plan.arrays.size(); ++b)
                if (const std::uint32_t cost = detail::merge_cost(plan.arrays[a], plan.arrays[b], max_layers);
                    cost < best)
                    best = cost, best_a = a, best_b = b;
        if (best == ~0u) break;
        TextureArrayPlan& a = plan.arrays[best_a];
        TextureArrayPlan& b = plan.arrays[best_b];
        const Extent2D size{std::max(a.size.width, b.size.width), std::max(a.size.height, b.size.height)};
        plan.warnings.push_back("textures of " + std::to_string(a.size.width) + "x" + std::to_string(a.size.height) +
                                " and " + std::to_string(b.size.width) + "x" + std::to_string(b.size.height) +
                                " share one array of " + std::to_string(size.width) + "x" +
                                std::to_string(size.height) + (a.sampler == b.sampler ? "" : " and one sampler") +
                                ": the scene has more kinds of texture than the " + std::to_string(max_arrays) +
                                " arrays");
        for (std::uint32_t image : b.images)
            if (!contains(a, image)) a.images.push_back(image);
        a.size = size;
        plan.arrays.erase(plan.arrays.begin() + static_cast<std::ptrdiff_t>(best_b));
    }
    for (const Wanted& w : wanted) {
        const SceneTexture& texture = scene.textures[w.texture];
        TexturePlan::Place& place = (w.srgb ? plan.as_color : plan.as_data)[w.texture];
        for (std::uint32_t pass = 0; pass < 2 && place.array == no_index; ++pass)
            for (std::uint32_t a = 0; a < plan.arrays.size() && place.array == no_index; ++a) {
                const TextureArrayPlan& array = plan.arrays[a];
                if (array.srgb != w.srgb || (pass == 0 && !(array.sampler == texture.sampler))) continue;
                const auto at = std::find(array.images.begin(), array.images.end(), texture.image);
                if (at != array.images.end()) place = {a, static_cast<std::uint32_t>(at - array.images.begin())};
            }
    }
    return plan;
}

}  // namespace pellucid::inline v0_1
