// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// From tinygltf's materials, textures and samplers to ours, and the pictures that they use.
#include <pellucid/scene/detail/gltf_data.hpp>
#include <pellucid/scene/detail/tiny_gltf.hpp>
#include <pellucid/scene/scene.hpp>
#include <algorithm>
#include <map>

namespace pellucid::inline v0_1::detail {

/// Reads materials first; then only the textures and images that they use are made.
class GltfLooks {
public:
    GltfLooks(const tinygltf::Model& model, Scene& scene) : model_(model), scene_(scene) {
        texture_of_.assign(model.textures.size(), no_index);
    }

    void read_materials(const GltfValue& root) {
        for (std::size_t i = 0; i < model_.materials.size(); ++i)
            scene_.materials.push_back(material(model_.materials[i], root["materials"][i]));
    }

    void read_images(const GltfValue& root, const GltfData& data, const std::filesystem::path& folder,
                     const GltfLimits& limits, GltfBudget& files) {
        std::uint64_t total = 0;
        scene_.images.resize(sources_.size());
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            const GltfValue value = root["images"][sources_[i]];
            SceneImage& image = scene_.images[i];
            image.name = value.text("name");
            std::vector<std::byte> owned;
            std::span<const std::byte> bytes;
            if (value.has("uri")) {
                auto& uri = value["uri"].json().get_ref<std::string&>();
                owned = GltfData::read_uri(value["uri"], uri, folder, files);
                if (image.name.empty() && !is_data_uri(uri)) image.name = uri;
                bytes = owned;
            } else {
                bytes = data.bytes(value.integer("bufferView"), value.pointer());
            }
            ImageLimits rest = limits.image;
            rest.max_bytes = std::min(rest.max_bytes, limits.max_all_image_bytes - total);
            image.pixels = gltf_value(decode_image(bytes, value.pointer(), rest));
            total += image.pixels.data.size();
        }
    }

private:
    void warn(const std::string& pointer, const std::string& what) {
        if (scene_.warnings.size() < 1000) scene_.warnings.push_back(pointer + ": " + what);
    }

    /// The number in Scene::textures of the file's texture `i`, made on first use; no_index where it has no image.
    std::uint32_t texture(std::size_t i) {
        if (texture_of_[i] != no_index) return texture_of_[i];
        const tinygltf::Texture& source = model_.textures[i];
        if (source.source < 0) {
            warn("/textures/" + std::to_string(i), "has no source that can be read: it is left out");
            return no_index;
        }
        SceneTexture texture;
        const auto image = static_cast<std::size_t>(source.source);
        const auto [found, fresh] = number_of_.try_emplace(image, static_cast<std::uint32_t>(sources_.size()));
        texture.image = found->second;
        if (fresh) sources_.push_back(image);
        if (source.sampler >= 0) texture.sampler = sampler(static_cast<std::size_t>(source.sampler));
        texture_of_[i] = static_cast<std::uint32_t>(scene_.textures.size());
        scene_.textures.push_back(texture);
        return texture_of_[i];
    }

    [[nodiscard]] TextureSampler sampler(std::size_t i) const {
        const tinygltf::Sampler& source = model_.samplers[i];
        const auto wrap = [&](int value, const char* key) {
            switch (value) {
                case 10497:
                    return TextureWrap::repeat;
                case 33648:
                    return TextureWrap::mirror;
                case 33071:
                    return TextureWrap::clamp;
                default:
                    unknown(i, key, value);
            }
        };
        TextureSampler sampler;
        sampler.wrap_u = wrap(source.wrapS, "wrapS");
        sampler.wrap_v = wrap(source.wrapT, "wrapT");
        if (source.magFilter == 9728) sampler.mag = TextureFilter::nearest;
        switch (source.minFilter) {
            case -1:
                break;  // the file leaves the choice to us: trilinear
            case 9728:
                sampler = with(sampler, TextureFilter::nearest, TextureFilter::nearest, false);
                break;
            case 9729:
                sampler = with(sampler, TextureFilter::linear, TextureFilter::nearest, false);
                break;
            case 9984:
                sampler = with(sampler, TextureFilter::nearest, TextureFilter::nearest, true);
                break;
            case 9985:
                sampler = with(sampler, TextureFilter::linear, TextureFilter::nearest, true);
                break;
            case 9986:
                sampler = with(sampler, TextureFilter::nearest, TextureFilter::linear, true);
                break;
            case 9987:
                break;
            default:
                unknown(i, "minFilter", source.minFilter);
        }
        return sampler;
    }
    [[noreturn]] static void unknown(std::size_t i, const char* key, int value) {
        gltf_fail("/samplers/" + std::to_string(i) + "/" + key + ": is " + std::to_string(value) +
                  ", which is no value of it");
    }
    static TextureSampler with(TextureSampler sampler, TextureFilter min, TextureFilter mip, bool mipmapped) {
        sampler.min = min;
        sampler.mip = mip;
        sampler.mipmapped = mipmapped;
        return sampler;
    }

    /// One of tinygltf's three kinds of texture info.
    template <class Info>
    TextureRef use(const Info& info, const std::string& pointer) {
        TextureRef ref;
        if (info.index < 0) return ref;
        ref.texture = texture(static_cast<std::size_t>(info.index));
        int uv_set = info.texCoord;
        const auto extension = info.extensions.find("KHR_texture_transform");
        if (extension != info.extensions.end()) {
            const tinygltf::Value& transform = extension->second;
            ref.offset = pair(transform, "offset", ref.offset);
            ref.scale = pair(transform, "scale", ref.scale);
            if (transform.Has("rotation"))
                ref.rotation = static_cast<float>(transform.Get("rotation").GetNumberAsDouble());
            if (transform.Has("texCoord")) uv_set = transform.Get("texCoord").GetNumberAsInt();
        }
        if (uv_set > 1) {
            warn(pointer, "uses TEXCOORD_" + std::to_string(uv_set) + ", only 0 and 1 are read: it is left out");
            return {};
        }
        ref.uv_set = static_cast<std::uint32_t>(uv_set);
        return ref;
    }
    static glm::vec2 pair(const tinygltf::Value& object, const char* key, glm::vec2 fallback) {
        if (!object.Has(key)) return fallback;
        const tinygltf::Value& value = object.Get(key);
        return {static_cast<float>(value.Get(0).GetNumberAsDouble()),
                static_cast<float>(value.Get(1).GetNumberAsDouble())};
    }

    Material material(const tinygltf::Material& source, const GltfValue& value) {
        Material material;
        material.name = source.name;
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        for (int c = 0; c < 4; ++c)
            material.base_color[c] = static_cast<float>(pbr.baseColorFactor[static_cast<std::size_t>(c)]);
        material.metallic = static_cast<float>(pbr.metallicFactor);
        material.roughness = static_cast<float>(pbr.roughnessFactor);
        double strength = 1;
        const auto emissive = source.extensions.find("KHR_materials_emissive_strength");
        if (emissive != source.extensions.end() && emissive->second.Has("emissiveStrength"))
            strength = emissive->second.Get("emissiveStrength").GetNumberAsDouble();
        for (int c = 0; c < 3; ++c)
            material.emissive[c] = static_cast<float>(source.emissiveFactor[static_cast<std::size_t>(c)] * strength);
        material.normal_scale = static_cast<float>(source.normalTexture.scale);
        material.occlusion_strength = static_cast<float>(source.occlusionTexture.strength);
        material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        if (source.alphaMode == "BLEND")
            material.alpha_mode = AlphaMode::blend;
        else if (source.alphaMode == "MASK")
            material.alpha_mode = AlphaMode::mask;
        else if (source.alphaMode != "OPAQUE")
            value["alphaMode"].fail("is \"" + gltf_printable(source.alphaMode) + "\", none of OPAQUE, MASK, BLEND");
        material.double_sided = source.doubleSided;
        material.unlit = source.extensions.count("KHR_materials_unlit") != 0;
        const std::string& at = value.pointer();
        material.base_color_texture = use(pbr.baseColorTexture, at + "/pbrMetallicRoughness/baseColorTexture");
        material.metallic_roughness_texture =
            use(pbr.metallicRoughnessTexture, at + "/pbrMetallicRoughness/metallicRoughnessTexture");
        material.normal_texture = use(source.normalTexture, at + "/normalTexture");
        material.occlusion_texture = use(source.occlusionTexture, at + "/occlusionTexture");
        material.emissive_texture = use(source.emissiveTexture, at + "/emissiveTexture");
        return material;
    }

    const tinygltf::Model& model_;
    Scene& scene_;
    std::vector<std::uint32_t> texture_of_;
    std::map<std::size_t, std::uint32_t> number_of_;  ///< the file's image -> Scene::images
    std::vector<std::size_t> sources_;                ///< the file's images, in order of use: index = Scene::images
};

}  // namespace pellucid::inline v0_1::detail
