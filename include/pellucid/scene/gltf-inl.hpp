// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of gltf.hpp.  Errors inside travel as `detail::GltfFailure`, which ends in `load_gltf`.
#include <pellucid/scene/detail/gltf_geometry.hpp>
#include <pellucid/scene/detail/gltf_looks.hpp>
#include <pellucid/scene/detail/gltf_nodes.hpp>
#include <pellucid/scene/detail/gltf_schema.hpp>
#include <pellucid/scene/gltf.hpp>
#include <cstdio>
#include <new>

namespace pellucid::inline v0_1 {
namespace detail {

/// "major.minor" with nothing around it.
inline std::optional<std::pair<unsigned, unsigned>> gltf_parse_version(const std::string& text) {
    unsigned major = 0, minor = 0;
    int length = 0;
    if (text.empty() || text.size() > 16 || text.find_first_not_of("0123456789.") != std::string::npos ||
        std::sscanf(text.c_str(), "%5u.%5u%n", &major, &minor, &length) != 2 ||
        static_cast<std::size_t>(length) != text.size())
        return std::nullopt;
    return std::pair{major, minor};
}

/// The version decides how everything else is to be read: it is looked at first.
inline void gltf_check_version(const GltfValue& root) {
    if (!root.json().is_object()) root.fail("must be an object, is " + std::string(root.json().type_name()));
    if (!root.has("asset")) root.fail("lacks the required member \"asset\"");
    const GltfValue asset = root["asset"];
    if (!asset.has("version") || !asset["version"].json().is_string())
        asset.fail("lacks the required member \"version\"");
    const auto version = gltf_parse_version(asset.text("version"));
    if (!version) asset["version"].fail("is \"" + gltf_printable(asset.text("version")) + "\", no major.minor");
    if (version->first != 2)
        asset["version"].fail("is " + asset.text("version") + ", only glTF 2 can be read; convert the file");
    if (!asset.has("minVersion") || !asset["minVersion"].json().is_string()) return;
    const auto least = gltf_parse_version(asset.text("minVersion"));
    if (!least || *least > *version || *least > std::pair{2u, 0u})
        asset["minVersion"].fail("is \"" + gltf_printable(asset.text("minVersion")) + "\", this loader reads 2.0");
}

inline void gltf_check_extensions(const GltfValue& root, Scene& scene) {
    constexpr std::string_view known[] = {"KHR_lights_punctual", "KHR_materials_unlit", "KHR_texture_transform",
                                          "KHR_materials_emissive_strength", "KHR_mesh_quantization"};
    const auto is_known = [&](const std::string& name) {
        return std::find(known, std::end(known), name) != std::end(known);
    };
    const auto names = [&](const char* key) {
        std::vector<std::string> list;
        if (root.has(key))
            for (const Json& name : root[key].json()) list.push_back(name.get<std::string>());
        return list;
    };
    const std::vector<std::string> required = names("extensionsRequired");
    for (std::size_t i = 0; i < required.size(); ++i)
        if (!is_known(required[i]))
            root["extensionsRequired"][i].fail("the file cannot be shown without the extension " +
                                               gltf_printable(required[i]) + ", which this loader does not know");
    for (const std::string& name : names("extensionsUsed"))
        if (!is_known(name) && scene.warnings.size() < 1000)
            scene.warnings.push_back("/extensionsUsed: " + gltf_printable(name) + " is left out");
}

/// Rules that tie members of one object together.
inline void gltf_check_objects(const GltfValue& root) {
    for (std::size_t i = 0; root.has("images") && i < root["images"].size(); ++i) {
        const GltfValue image = root["images"][i];
        if (image.has("uri") == image.has("bufferView"))
            image.fail(image.has("uri") ? "has both a uri and a bufferView" : "has neither a uri nor a bufferView");
        if (image.has("bufferView") && !image.has("mimeType")) image.fail("has a bufferView but no mimeType");
    }
    for (std::size_t i = 0; root.has("cameras") && i < root["cameras"].size(); ++i) {
        const GltfValue camera = root["cameras"][i];
        const std::string type = camera.text("type");
        if (type != "perspective" && type != "orthographic")
            camera["type"].fail("is \"" + gltf_printable(type) + "\", neither perspective nor orthographic");
        if (!camera.has(type.c_str()) || camera.has(type == "perspective" ? "orthographic" : "perspective"))
            camera.fail("is " + type + ", must have the member \"" + type + "\" and not the other one");
    }
    std::size_t lights = 0;
    if (root.has("extensions") && root["extensions"].has("KHR_lights_punctual")) {
        const GltfValue list = root["extensions"]["KHR_lights_punctual"]["lights"];
        lights = list.size();
        for (std::size_t i = 0; i < lights; ++i)
            if (list[i].text("type") == "spot" && !list[i].has("spot"))
                list[i].fail("is a spot, lacks the member \"spot\"");
    }
    for (std::size_t i = 0; root.has("animations") && i < root["animations"].size(); ++i) {
        const GltfValue channels = root["animations"][i]["channels"];
        const std::size_t samplers = root["animations"][i]["samplers"].size();
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (channels[c].integer("sampler") >= samplers)
                channels[c]["sampler"].fail("is " + channels[c]["sampler"].json().dump() + ", the animation has " +
                                            std::to_string(samplers) + " samplers");
    }
    for (std::size_t i = 0; root.has("nodes") && i < root["nodes"].size(); ++i) {
        const GltfValue node = root["nodes"][i];
        if (node.has("matrix") && (node.has("translation") || node.has("rotation") || node.has("scale")))
            node.fail("has a matrix and also a translation, rotation or scale");
        if (node.has("skin") && !node.has("mesh")) node.fail("has a skin but no mesh");
        if (!node.has("extensions") || !node["extensions"].has("KHR_lights_punctual")) continue;
        const GltfValue light = node["extensions"]["KHR_lights_punctual"]["light"];
        if (light.json().get<std::uint64_t>() >= lights)
            light.fail("is " + light.json().dump() + ", the file has " + std::to_string(lights) + " lights");
    }
}

/// The descriptive tables through tinygltf.  Given no buffers, images or meshes, it touches no file and no memory but
/// that of the tables, which is paid for first: an empty object in the file is three bytes, as a material a thousand.
inline tinygltf::Model gltf_describe(const Json& root, GltfBudget& budget) {
    const auto size = [&](const char* key) {
        const auto found = root.find(key);
        return found == root.end() ? std::size_t{0} : found->size();
    };
    const auto pay = [&](const char* key, std::size_t bytes) {
        budget.take(size(key) * bytes, "/" + std::string(key), "tables");
    };
    pay("scenes", sizeof(tinygltf::Scene));
    pay("nodes", sizeof(tinygltf::Node));
    pay("materials", sizeof(tinygltf::Material) + sizeof(Material));
    pay("textures", sizeof(tinygltf::Texture));
    pay("samplers", sizeof(tinygltf::Sampler));
    pay("cameras", sizeof(tinygltf::Camera));
    Json tables = Json::object();
    for (const char* key :
         {"asset", "scene", "scenes", "nodes", "materials", "textures", "samplers", "cameras", "extensions"})
        if (const auto found = root.find(key); found != root.end()) tables[key] = *found;
    const std::string text = tables.dump();
    tables = Json();
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error, warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "")) {
        for (char& c : error)
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
        gltf_fail("/: tinygltf cannot read the document: " + error);
    }
    if (model.nodes.size() != size("nodes") || model.materials.size() != size("materials") ||
        model.textures.size() != size("textures") || model.samplers.size() != size("samplers") ||
        model.cameras.size() != size("cameras") || model.scenes.size() != size("scenes"))
        gltf_fail("/: tinygltf read a table to another length than it has", Errc::internal);
    return model;
}

/// Every primitive of every mesh, in file order; returns the scene's meshes of each of the file's.
inline std::vector<std::vector<std::uint32_t>> gltf_read_meshes(const GltfValue& root, GltfGeometry& geometry,
                                                                Scene& scene) {
    std::vector<std::vector<std::uint32_t>> primitives;
    if (!root.has("meshes")) return primitives;
    const GltfValue meshes = root["meshes"];
    primitives.resize(meshes.size());
    const std::size_t own_materials = scene.materials.size();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const GltfValue list = meshes[m]["primitives"];
        for (std::size_t p = 0; p < list.size(); ++p) {
            if (!list[p].has("material") && scene.materials.size() == own_materials)
                scene.materials.push_back({.name = "default"});
            const std::uint64_t material = list[p].integer("material", own_materials);
            if (geometry.append(list[p], meshes[m].text("name"), static_cast<std::uint32_t>(material)))
                primitives[m].push_back(static_cast<std::uint32_t>(scene.meshes.size() - 1));
        }
    }
    return primitives;
}

inline Scene gltf_load(const std::string& path, const GltfLimits& limits) {
    std::vector<std::byte> bytes = gltf_value(read_file(path, limits.max_file_bytes));
    GltfBudget files{.limit = limits.max_file_bytes, .used = bytes.size()};
    const std::uint64_t own_bytes = bytes.size();
    const GltfContainer container = gltf_open(bytes);
    Json document = gltf_parse_json(container.json, limits);
    if (!container.binary) bytes = {};
    const GltfValue root(document, "");
    Scene scene;
    gltf_check_version(root);
    GltfSchema(document).check(root, GltfObject::root);
    gltf_check_extensions(root, scene);
    gltf_check_objects(root);
    for (const char* key : {"animations", "skins"})
        if (root.has(key)) scene.warnings.push_back("/" + std::string(key) + ": are left out: the rest pose is shown");

    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const GltfData data(root, container, folder, files);
    const std::uint64_t grown = (own_bytes + data.loaded_bytes()) * limits.max_growth;
    GltfBudget budget{.limit = std::min(limits.max_scene_bytes, (std::uint64_t{16} << 20u) + grown)};
    const tinygltf::Model model = gltf_describe(document, budget);
    GltfLooks looks(model, scene);
    looks.read_materials(root);

    bool quantization = false;
    for (const char* key : {"extensionsUsed", "extensionsRequired"})
        for (const Json& name : root.has(key) ? root[key].json() : Json::array())
            quantization = quantization || name == "KHR_mesh_quantization";
    GltfGeometry geometry(data, scene, budget, quantization);
    const auto primitives = gltf_read_meshes(root, geometry, scene);
    GltfNodes nodes(model, scene, primitives, limits.max_node_depth, budget);
    nodes.check();
    nodes.place();
    looks.read_images(root, data, folder, limits, files);
    return scene;
}

}  // namespace detail

PELLUCID_INLINE Result<Scene> load_gltf(const std::string& path, const GltfLimits& limits) {
    try {
        return detail::gltf_load(path, limits);
    } catch (const detail::GltfFailure& failure) {
        const std::string& text = failure.error.message;
        return Error{failure.error.code, text.substr(0, path.size() + 1) == path + ":" ? text : path + ": " + text};
    } catch (const std::bad_alloc&) {
        return Error{Errc::out_of_memory, path + ": there is not enough memory for the scene"};
    } catch (const std::exception& exception) {
        return Error{Errc::internal, path + ": cannot be read: " + exception.what()};
    }
}

}  // namespace pellucid::inline v0_1
