// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Definitions of gltf_write.hpp.
#include <pellucid/scene/detail/png.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace pellucid::inline v0_1 {
namespace detail {

/// Collects the JSON tables and the binary chunk of a file.
class GltfWriter {
public:
    explicit GltfWriter(const Scene& scene) : scene_(scene) {}

    Result<std::vector<std::byte>> write(const std::string& path) {
        root_ = {{"asset", {{"version", "2.0"}, {"generator", "pellucid"}}}, {"scene", 0}};
        PELLUCID_CHECK(add_images(path));
        for (const SceneTexture& texture : scene_.textures) PELLUCID_CHECK(add_texture(path, texture));
        for (const Material& material : scene_.materials) PELLUCID_CHECK(add_material(path, material));
        for (const Mesh& mesh : scene_.meshes) PELLUCID_CHECK(add_mesh(path, mesh));
        add_nodes();
        for (const Instance& instance : scene_.instances)
            if (instance.mesh >= scene_.meshes.size())
                return Error{Errc::invalid_argument, path + ": an instance has mesh " + std::to_string(instance.mesh) +
                                                         ", the scene has " + std::to_string(scene_.meshes.size())};
        if (!used_.empty()) root_["extensionsUsed"] = used_;
        return pack(path);
    }

private:
    using Json = nlohmann::json;

    void use_extension(const char* name) {
        if (std::find(used_.begin(), used_.end(), name) == used_.end()) used_.push_back(name);
    }
    template <class V>
    static Json numbers(const V& values) {
        Json list = Json::array();
        for (int i = 0; i < V::length(); ++i) list.push_back(static_cast<double>(values[i]));
        return list;
    }

    /// Appends bytes to the binary chunk at a multiple of four; returns the view's number.
    std::size_t add_view(const void* data, std::size_t size, int target) {
        bin_.resize((bin_.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", size}};
        if (target != 0) view["target"] = target;
        const auto* bytes = static_cast<const std::byte*>(data);
        bin_.insert(bin_.end(), bytes, bytes + size);
        root_["bufferViews"].push_back(std::move(view));
        return root_["bufferViews"].size() - 1;
    }
    template <class T>
    std::size_t add_accessor(const std::vector<T>& values, const char* type, int component, int target) {
        const std::size_t view = add_view(values.data(), values.size() * sizeof(T), target);
        root_["accessors"].push_back(
            {{"bufferView", view}, {"componentType", component}, {"count", values.size()}, {"type", type}});
        return root_["accessors"].size() - 1;
    }

    Result<void> add_images(const std::string& path) {
        for (const SceneImage& image : scene_.images) {
            PELLUCID_TRY(const std::vector<std::byte> png, encode_png(image.pixels, path + ": image " + image.name));
            Json entry = {{"bufferView", add_view(png.data(), png.size(), 0)}, {"mimeType", "image/png"}};
            if (!image.name.empty()) entry["name"] = image.name;
            root_["images"].push_back(std::move(entry));
        }
        return {};
    }

    Result<void> add_texture(const std::string& path, const SceneTexture& texture) {
        if (texture.image >= scene_.images.size())
            return Error{Errc::invalid_argument, path + ": a texture has image " + std::to_string(texture.image) +
                                                     ", the scene has " + std::to_string(scene_.images.size())};
        const auto wrap = [](TextureWrap w) {
            return w == TextureWrap::repeat ? 10497 : w == TextureWrap::mirror ? 33648 : 33071;
        };
        const TextureSampler& s = texture.sampler;
        const int linear = s.min == TextureFilter::linear ? 1 : 0;
        const int filter = s.mipmapped ? 9984 + linear + (s.mip == TextureFilter::linear ? 2 : 0) : 9728 + linear;
        root_["samplers"].push_back({{"magFilter", s.mag == TextureFilter::linear ? 9729 : 9728},
                                     {"minFilter", filter},
                                     {"wrapS", wrap(s.wrap_u)},
                                     {"wrapT", wrap(s.wrap_v)}});
        root_["textures"].push_back({{"sampler", root_["samplers"].size() - 1}, {"source", texture.image}});
        return {};
    }

    Json texture_use(const TextureRef& ref) {
        Json use = {{"index", ref.texture}, {"texCoord", ref.uv_set}};
        if (ref.offset != glm::vec2(0) || ref.scale != glm::vec2(1) || ref.rotation != 0) {
            use_extension("KHR_texture_transform");
            use["extensions"]["KHR_texture_transform"] = {{"offset", numbers(ref.offset)},
                                                          {"scale", numbers(ref.scale)},
                                                          {"rotation", static_cast<double>(ref.rotation)}};
        }
        return use;
    }

    Result<void> add_material(const std::string& path, const Material& m) {
        for (const TextureRef* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                      &m.occlusion_texture, &m.emissive_texture})
            if (ref->used() && ref->texture >= scene_.textures.size())
                return Error{Errc::invalid_argument, path + ": material " + m.name + " has texture " +
                                                         std::to_string(ref->texture) + ", the scene has " +
                                                         std::to_string(scene_.textures.size())};
        Json pbr = {{"baseColorFactor", numbers(m.base_color)},
                    {"metallicFactor", static_cast<double>(m.metallic)},
                    {"roughnessFactor", static_cast<double>(m.roughness)}};
        if (m.base_color_texture.used()) pbr["baseColorTexture"] = texture_use(m.base_color_texture);
        if (m.metallic_roughness_texture.used())
            pbr["metallicRoughnessTexture"] = texture_use(m.metallic_roughness_texture);
        Json entry = {{"pbrMetallicRoughness", std::move(pbr)}};
        if (!m.name.empty()) entry["name"] = m.name;
        if (m.normal_texture.used()) {
            entry["normalTexture"] = texture_use(m.normal_texture);
            entry["normalTexture"]["scale"] = static_cast<double>(m.normal_scale);
        }
        if (m.occlusion_texture.used()) {
            entry["occlusionTexture"] = texture_use(m.occlusion_texture);
            entry["occlusionTexture"]["strength"] = static_cast<double>(m.occlusion_strength);
        }
        if (m.emissive_texture.used()) entry["emissiveTexture"] = texture_use(m.emissive_texture);
        // The factor ends at 1; what is above goes into the strength.
        const double strength = std::max({1.0, double{m.emissive.x}, double{m.emissive.y}, double{m.emissive.z}});
        if (m.emissive != glm::vec3(0)) entry["emissiveFactor"] = numbers(glm::dvec3(m.emissive) / strength);
        if (strength > 1) {
            use_extension("KHR_materials_emissive_strength");
            entry["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
        }
        if (m.unlit) {
            use_extension("KHR_materials_unlit");
            entry["extensions"]["KHR_materials_unlit"] = Json::object();
        }
        if (m.alpha_mode != AlphaMode::opaque) entry["alphaMode"] = m.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
        if (m.alpha_mode == AlphaMode::mask) entry["alphaCutoff"] = static_cast<double>(m.alpha_cutoff);
        if (m.double_sided) entry["doubleSided"] = true;
        root_["materials"].push_back(std::move(entry));
        return {};
    }

    Result<void> add_mesh(const std::string& path, const Mesh& mesh) {
        const std::size_t count = mesh.positions.size();
        const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
        const auto bad = [&](const std::string& what) {
            return Error{Errc::invalid_argument, path + ": mesh " + mesh.name + " " + what};
        };
        if (count == 0 || mesh.indices.empty() || mesh.indices.size() % 3 != 0)
            return bad("has " + std::to_string(count) + " positions and " + std::to_string(mesh.indices.size()) +
                       " indices, which make no triangles");
        if (mesh.normals.size() != count || !fits(mesh.tangents.size()) || !fits(mesh.uv0.size()) ||
            !fits(mesh.uv1.size()) || !fits(mesh.colors.size()))
            return bad("has attributes of other lengths than its " + std::to_string(count) + " positions");
        if (*std::max_element(mesh.indices.begin(), mesh.indices.end()) >= count)
            return bad("has an index beyond its " + std::to_string(count) + " positions");
        if (mesh.material >= scene_.materials.size())
            return bad("has material " + std::to_string(mesh.material) + ", the scene has " +
                       std::to_string(scene_.materials.size()));
        constexpr int f32 = 5126, u32 = 5125, vertices = 34962, indices = 34963;
        Json attributes;
        attributes["POSITION"] = add_accessor(mesh.positions, "VEC3", f32, vertices);
        glm::vec3 lower = mesh.positions[0], upper = lower;
        for (const glm::vec3& p : mesh.positions)
            for (int c = 0; c < 3; ++c) {
                lower[c] = std::min(lower[c], p[c]);
                upper[c] = std::max(upper[c], p[c]);
            }
        root_["accessors"].back()["min"] = numbers(lower);
        root_["accessors"].back()["max"] = numbers(upper);
        attributes["NORMAL"] = add_accessor(mesh.normals, "VEC3", f32, vertices);
        if (!mesh.tangents.empty()) attributes["TANGENT"] = add_accessor(mesh.tangents, "VEC4", f32, vertices);
        if (!mesh.uv0.empty()) attributes["TEXCOORD_0"] = add_accessor(mesh.uv0, "VEC2", f32, vertices);
        if (!mesh.uv1.empty()) attributes["TEXCOORD_1"] = add_accessor(mesh.uv1, "VEC2", f32, vertices);
        if (!mesh.colors.empty()) attributes["COLOR_0"] = add_accessor(mesh.colors, "VEC4", f32, vertices);
        Json primitive = {{"attributes", std::move(attributes)},
                          {"indices", add_accessor(mesh.indices, "SCALAR", u32, indices)},
                          {"material", mesh.material}};
        Json entry = {{"primitives", Json::array({std::move(primitive)})}};
        if (!mesh.name.empty()) entry["name"] = mesh.name;
        root_["meshes"].push_back(std::move(entry));
        return {};
    }

    static Json matrix(const glm::dmat4& m) {
        Json list = Json::array();
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) list.push_back(m[c][r]);
        return list;
    }
    void add_node(Json node, const glm::dmat4& world) {
        if (world != glm::dmat4(1.0)) node["matrix"] = matrix(world);
        root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
        root_["nodes"].push_back(std::move(node));
    }
    void add_nodes() {
        root_["scenes"] = Json::array({Json::object()});
        for (const Instance& instance : scene_.instances)
            add_node({{"mesh", instance.mesh}}, instance.world_from_object);
        for (const Camera& camera : scene_.cameras) {
            Json entry;
            if (!camera.name.empty()) entry["name"] = camera.name;
            if (camera.projection == Projection::perspective) {
                entry["type"] = "perspective";
                entry["perspective"] = {{"yfov", camera.vertical_fov}, {"znear", camera.near}};
            } else {
                entry["type"] = "orthographic";
                entry["orthographic"] = {{"xmag", camera.half_width},
                                         {"ymag", camera.half_height},
                                         {"znear", camera.near},
                                         {"zfar", camera.far}};
            }
            root_["cameras"].push_back(std::move(entry));
            add_node({{"camera", root_["cameras"].size() - 1}}, camera.world_from_view);
        }
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) add_light(scene_.lights[i], i);
    }
    void add_light(const Light& light, std::size_t i) {
        use_extension("KHR_lights_punctual");
        constexpr const char* kinds[] = {"directional", "point", "spot"};
        Json entry = {{"type", kinds[static_cast<std::size_t>(light.kind)]},
                      {"color", numbers(light.color)},
                      {"intensity", static_cast<double>(light.intensity)}};
        if (!light.name.empty()) entry["name"] = light.name;
        if (light.range > 0) entry["range"] = static_cast<double>(light.range);
        if (light.kind == LightKind::spot)
            entry["spot"] = {{"innerConeAngle", light.inner_cone}, {"outerConeAngle", light.outer_cone}};
        root_["extensions"]["KHR_lights_punctual"]["lights"].push_back(std::move(entry));
        // The light shines along -z of its node.
        const glm::dvec3 z = -light.direction;
        const glm::dvec3 x =
            glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
        const glm::dmat4 world(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
                               glm::dvec4(light.position, 1));
        Json node;
        node["extensions"]["KHR_lights_punctual"] = {{"light", i}};
        add_node(std::move(node), light.direction == glm::dvec3(0, 0, -1) ? translation(light.position) : world);
    }
    static glm::dmat4 translation(glm::dvec3 position) {
        glm::dmat4 world(1.0);
        world[3] = glm::dvec4(position, 1);
        return world;
    }

    Result<std::vector<std::byte>> pack(const std::string& path) {
        bin_.resize((bin_.size() + 3) / 4 * 4);
        if (!bin_.empty()) root_["buffers"] = Json::array({{{"byteLength", bin_.size()}}});
        std::string json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
        json.resize((json.size() + 3) / 4 * 4, ' ');
        const std::uint64_t total = 20 + json.size() + (bin_.empty() ? 0 : 8 + bin_.size());
        if (total > 0xFFFFFFFFu)
            return Error{Errc::invalid_argument,
                         path + ": the scene takes " + std::to_string(total) + " bytes, a .glb holds 4294967295"};
        std::vector<std::byte> bytes;
        bytes.reserve(total);
        const auto word = [&](std::uint64_t value) {
            for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(value >> shift & 0xFFu));
        };
        const auto append = [&](const void* data, std::size_t size) {
            bytes.insert(bytes.end(), static_cast<const std::byte*>(data), static_cast<const std::byte*>(data) + size);
        };
        word(0x46546C67u), word(2), word(total);
        word(json.size()), word(0x4E4F534Au);
        append(json.data(), json.size());
        if (!bin_.empty()) {
            word(bin_.size()), word(0x004E4942u);
            append(bin_.data(), bin_.size());
        }
        return bytes;
    }

    const Scene& scene_;
    Json root_;
    std::vector<std::byte> bin_;
    std::vector<std::string> used_;
};

}  // namespace detail

PELLUCID_INLINE Result<void> write_gltf(const std::string& path, const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (scene.materials[i].premultiplied)
            return Error{Errc::invalid_argument, path + ": material " + std::to_string(i) + " (\"" +
                                                     scene.materials[i].name +
                                                     "\") is premultiplied, which glTF cannot say: leave it out"};
    PELLUCID_TRY(const std::vector<std::byte> bytes, detail::GltfWriter(scene).write(path));
    return detail::write_file(path, bytes);
}

}  // namespace pellucid::inline v0_1
