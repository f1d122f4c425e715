// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// From a checked glTF primitive to a `Mesh`.
#include <pellucid/scene/detail/gltf_data.hpp>
#include <pellucid/scene/scene.hpp>
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include <algorithm>

namespace pellucid::inline v0_1::detail {

/// Which accessor formats an attribute may have.
struct GltfAttributeRule {
    const char* name;
    const char* types[2];  ///< the second may be null
    bool f32 = true;
    bool normalized_u8_u16 = false;
    bool quantized = false;  ///< more under KHR_mesh_quantization: i8, i16 (and u8, u16 where `quantized_unsigned`)
    bool quantized_unsigned = false;
};
inline constexpr GltfAttributeRule gltf_attribute_rules[] = {
    {.name = "POSITION", .types = {"VEC3", nullptr}, .quantized = true, .quantized_unsigned = true},
    {.name = "NORMAL", .types = {"VEC3", nullptr}, .quantized = true},
    {.name = "TANGENT", .types = {"VEC4", nullptr}, .quantized = true},
    {.name = "TEXCOORD_0",
     .types = {"VEC2", nullptr},
     .normalized_u8_u16 = true,
     .quantized = true,
     .quantized_unsigned = true},
    {.name = "TEXCOORD_1",
     .types = {"VEC2", nullptr},
     .normalized_u8_u16 = true,
     .quantized = true,
     .quantized_unsigned = true},
    {.name = "COLOR_0", .types = {"VEC3", "VEC4"}, .normalized_u8_u16 = true},
};

/// Makes meshes and keeps account of what they take.
class GltfGeometry {
public:
    GltfGeometry(const GltfData& data, Scene& scene, GltfBudget& budget, bool quantization)
        : data_(data), scene_(scene), budget_(budget), quantization_(quantization) {}

    /// Appends the primitive to the scene's meshes; false, with a warning, where it has nothing that can be drawn.
    /// `material` is valid.
    bool append(const GltfValue& primitive, const std::string& name, std::uint32_t material) {
        const std::uint64_t mode = primitive.integer("mode", 4);
        const GltfValue attributes = primitive["attributes"];
        if (attributes.has("POSITION") && attributes.size() != 0) check_attributes(attributes);
        if (primitive.has("targets") && !warned_morph_) {
            warn(primitive, "morph targets are left out: the rest pose is shown");
            warned_morph_ = true;
        }
        if (mode < 4) return warn(primitive, "mode " + std::to_string(mode) + " (points or lines) is left out");
        if (!attributes.has("POSITION")) return warn(primitive, "has no POSITION and is left out");

        const GltfAccessor& positions = accessor(attributes, "POSITION");
        std::vector<std::uint32_t> corners = read_corners(primitive, positions.count, mode);
        if (corners.empty()) return warn(primitive, "has no complete triangle and is left out");

        const Material& look = scene_.materials[material];
        Mesh mesh;
        mesh.name = name;
        mesh.material = material;
        const bool flat = !attributes.has("NORMAL");
        // `sources[v]` is the accessor element that becomes vertex v: only those that are used; one a corner if flat.
        std::vector<std::uint32_t> sources;
        if (flat) {
            sources = std::move(corners);
            mesh.indices.resize(sources.size());
            for (std::size_t i = 0; i < sources.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
        } else {
            sources = compact(corners, positions.count);
            mesh.indices = std::move(corners);
        }
        budget_.take(sizeof(Mesh) + sources.size() * std::uint64_t{72} + mesh.indices.size() * std::uint64_t{4},
                     primitive.pointer(), "the meshes");

        read(attributes, "POSITION", sources, mesh.positions);
        if (flat)
            make_flat_normals(mesh);
        else
            read_normals(attributes, sources, mesh);
        if (attributes.has("TEXCOORD_0")) read(attributes, "TEXCOORD_0", sources, mesh.uv0);
        if (attributes.has("TEXCOORD_1")) read(attributes, "TEXCOORD_1", sources, mesh.uv1);
        if (attributes.has("COLOR_0")) read_colors(attributes, sources, mesh);
        mesh.lower = mesh.upper = mesh.positions[0];
        for (const glm::vec3& p : mesh.positions)
            for (int c = 0; c < 3; ++c) {
                mesh.lower[c] = std::min(mesh.lower[c], p[c]);
                mesh.upper[c] = std::max(mesh.upper[c], p[c]);
            }
        if (look.normal_texture.used()) {
            // Tangents of a file that has no normals are to be left out: they were made for other normals.
            if (attributes.has("TANGENT") && !flat)
                read_tangents(attributes, sources, mesh);
            else
                derive_tangents(look.normal_texture, mesh);
        }
        check_texture_coordinates(primitive, look, mesh);
        scene_.meshes.push_back(std::move(mesh));
        return true;
    }

private:
    bool warn(const GltfValue& place, const std::string& what) {
        if (scene_.warnings.size() < 1000) scene_.warnings.push_back(place.pointer() + ": " + what);
        return false;
    }
    [[nodiscard]] const GltfAccessor& accessor(const GltfValue& attributes, const char* name) const {
        return data_.accessors()[attributes.integer(name)];
    }

    void check_attributes(const GltfValue& attributes) const {
        const std::uint64_t count = accessor(attributes, "POSITION").count;
        for (auto& [key, value] : attributes.json().items()) {
            const GltfAccessor& found = data_.accessors()[value.get<std::uint64_t>()];
            const GltfValue place(value, attributes.pointer() + "/" + GltfValue::escape(key));
            if (found.count != count)
                place.fail("has " + std::to_string(found.count) + " elements, POSITION has " + std::to_string(count));
            for (const GltfAttributeRule& rule : gltf_attribute_rules)
                if (key == rule.name) check_format(place, found, rule);
        }
    }
    void check_format(const GltfValue& place, const GltfAccessor& found, const GltfAttributeRule& rule) const {
        const bool type = found.type == rule.types[0] || (rule.types[1] && found.type == rule.types[1]);
        const bool narrow = gltf_size(found.component) < 4;
        const bool is_signed = found.component == GltfComponent::i8 || found.component == GltfComponent::i16;
        // Quantised directions must be normalised; positions and texture coordinates need not be.
        const bool quantized = quantization_ && rule.quantized && narrow &&
                               (is_signed ? rule.quantized_unsigned || found.normalized : rule.quantized_unsigned);
        const bool component = (rule.f32 && found.component == GltfComponent::f32) ||
                               (rule.normalized_u8_u16 && narrow && !is_signed && found.normalized) || quantized;
        if (!type || !component)
            place.fail("the accessor is " + found.type + " of component type " +
                       std::to_string(static_cast<std::uint32_t>(found.component)) +
                       (found.normalized ? " (normalized)" : "") + ", which " + rule.name + " may not be");
    }

    /// The triangle list's corners: elements of the attributes, three a triangle.
    std::vector<std::uint32_t> read_corners(const GltfValue& primitive, std::uint64_t vertices, std::uint64_t mode) {
        const bool indexed = primitive.has("indices");
        std::optional<GltfReader> index_reader;
        std::uint32_t restart = 0xFFFFFFFFu;  // the largest value of the indices' type: graphics APIs restart there
        if (indexed) {
            const GltfAccessor& found = data_.accessors()[primitive.integer("indices")];
            const bool is_unsigned = found.component == GltfComponent::u8 || found.component == GltfComponent::u16 ||
                                     found.component == GltfComponent::u32;
            if (found.type != "SCALAR" || !is_unsigned || found.normalized)
                primitive["indices"].fail("the accessor is " + found.type + " of component type " +
                                          std::to_string(static_cast<std::uint32_t>(found.component)) +
                                          ", indices are SCALAR of 5121, 5123 or 5125, not normalized");
            if (found.view != GltfAccessor::npos && data_.view(found.view).stride != 0 &&
                data_.view(found.view).stride != found.element_size)
                primitive["indices"].fail("the accessor has a byteStride of " +
                                          std::to_string(data_.view(found.view).stride) + ", indices have none");
            index_reader.emplace(reader(found));
            restart >>= 32 - 8 * gltf_size(found.component);
        }
        const std::uint64_t count = index_reader ? index_reader->size() : vertices;
        if (vertices > 0xFFFFFFFFu || count > 0xFFFFFFFFu)
            primitive.fail("has " + std::to_string(std::max(vertices, count)) + " vertices, the limit is 4294967295");
        const std::uint64_t triangles = mode == 4 ? count / 3 : count < 3 ? 0 : count - 2;
        if (mode == 4 && count % 3 != 0)
            warn(primitive, std::to_string(count) + " indices are no multiple of 3: the rest is left out");
        // Checked before the list is made: an accessor without a view has any count it likes.
        if (triangles * 12 > budget_.limit - budget_.used)
            primitive.fail("has " + std::to_string(triangles) + " triangles, which takes more than the limit of " +
                           std::to_string(budget_.limit) + " bytes for this file");
        const auto corner = [&](std::uint64_t i) {
            const std::uint32_t index = index_reader ? index_reader->index(i) : static_cast<std::uint32_t>(i);
            if (index >= vertices || (index_reader && index == restart))
                primitive["indices"].fail(
                    "index " + std::to_string(i) + " is " + std::to_string(index) +
                    (index_reader && index == restart ? ", the value that restarts primitives; the" : ", the") +
                    " primitive has " + std::to_string(vertices) + " vertices");
            return index;
        };
        // Every index is checked, also those that make no triangle.
        for (std::uint64_t i = mode == 4 ? triangles * 3 : triangles ? count : 0; i < count; ++i) corner(i);
        std::vector<std::uint32_t> corners(triangles * 3);
        for (std::uint64_t t = 0; t < triangles; ++t) {
            std::uint64_t a = 3 * t, b = a + 1, c = a + 2;
            if (mode == 5) a = t, b = t + 1 + t % 2, c = t + 2 - t % 2;
            if (mode == 6) a = t + 1, b = t + 2, c = 0;
            corners[3 * t] = corner(a);
            corners[3 * t + 1] = corner(b);
            corners[3 * t + 2] = corner(c);
        }
        return corners;
    }

    /// Renumbers `corners` so that only used elements remain, in their order; returns the elements.
    static std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& corners, std::uint64_t vertices) {
        std::vector<std::uint32_t> sources;
        // Sorting costs n log n of the corners; a table costs the vertices, which may be many more than are used.
        if (vertices <= corners.size() * std::uint64_t{4} + 1024) {
            std::vector<std::uint32_t> number(vertices, 0);
            for (const std::uint32_t c : corners) number[c] = 1;
            for (std::uint32_t v = 0; v < vertices; ++v)
                if (number[v] != 0) {
                    number[v] = static_cast<std::uint32_t>(sources.size());
                    sources.push_back(v);
                }
            for (std::uint32_t& c : corners) c = number[c];
            return sources;
        }
        sources = corners;
        std::sort(sources.begin(), sources.end());
        sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
        for (std::uint32_t& c : corners)
            c = static_cast<std::uint32_t>(std::lower_bound(sources.begin(), sources.end(), c) - sources.begin());
        return sources;
    }

    /// A reader of an accessor; its sparse part is paid for, since it is looked through each time.
    [[nodiscard]] GltfReader reader(const GltfAccessor& accessor) const {
        budget_.take(accessor.sparse_count * 4, accessor.pointer, "the meshes");
        return GltfReader(data_, accessor);
    }

    /// Reads an attribute's used elements; every component must be finite.
    template <class T>
    void read(const GltfValue& attributes, const char* name, const std::vector<std::uint32_t>& sources,
              std::vector<T>& values, std::uint32_t width = static_cast<std::uint32_t>(T::length())) const {
        const GltfAccessor& source = accessor(attributes, name);
        const GltfReader elements = reader(source);
        values.resize(sources.size());
        for (std::size_t v = 0; v < sources.size(); ++v)
            for (std::uint32_t c = 0; c < width; ++c) {
                const float number = elements.number(sources[v], c);
                if (!std::isfinite(number))
                    gltf_fail(source.pointer + ": component " + std::to_string(c) + " of element " +
                              std::to_string(sources[v]) + " is " + std::to_string(number) + ", " + name +
                              " must be finite");
                values[v][static_cast<int>(c)] = number;
            }
    }

    /// Lengths differ from 1 by quantisation and carelessness, by rounding too: that is left alone, so that what was
    /// written comes back.  A zero vector becomes `otherwise`.
    static glm::vec3 unit(glm::vec3 v, glm::vec3 otherwise) {
        const glm::dvec3 d(v);
        const double length = glm::length(d);
        if (std::abs(length - 1.0) <= 1e-6) return v;
        return length > 0 ? glm::vec3(d / length) : otherwise;
    }
    void read_normals(const GltfValue& attributes, const std::vector<std::uint32_t>& sources, Mesh& mesh) const {
        read(attributes, "NORMAL", sources, mesh.normals);
        for (glm::vec3& normal : mesh.normals) normal = unit(normal, {0, 1, 0});
    }
    static void make_flat_normals(Mesh& mesh) {
        mesh.normals.resize(mesh.positions.size());
        for (std::size_t t = 0; t + 2 < mesh.positions.size(); t += 3) {
            const glm::dvec3 a(mesh.positions[t]), b(mesh.positions[t + 1]), c(mesh.positions[t + 2]);
            const glm::dvec3 n = glm::cross(b - a, c - a);
            const double length = glm::length(n);
            const glm::vec3 normal = length > 0 ? glm::vec3(n / length) : glm::vec3(0, 1, 0);
            mesh.normals[t] = mesh.normals[t + 1] = mesh.normals[t + 2] = normal;
        }
    }
    void read_tangents(const GltfValue& attributes, const std::vector<std::uint32_t>& sources, Mesh& mesh) const {
        read(attributes, "TANGENT", sources, mesh.tangents);
        for (std::size_t v = 0; v < mesh.tangents.size(); ++v) {
            const glm::vec4 t = mesh.tangents[v];
            mesh.tangents[v] = glm::vec4(unit(glm::vec3(t), any_tangent(mesh.normals[v])), t.w < 0 ? -1.0f : 1.0f);
        }
    }
    void read_colors(const GltfValue& attributes, const std::vector<std::uint32_t>& sources, Mesh& mesh) const {
        const std::uint32_t width = accessor(attributes, "COLOR_0").width;
        read(attributes, "COLOR_0", sources, mesh.colors, width);
        for (glm::vec4& color : mesh.colors) {
            if (width == 3) color.w = 1;
            for (int c = 0; c < 4; ++c) color[c] = std::clamp(color[c], 0.0f, 1.0f);
        }
    }
    static void derive_tangents(const TextureRef& use, Mesh& mesh) {
        const std::vector<glm::vec2> uv = use.uv_set == 1 ? mesh.uv1 : mesh.uv0;
        if (!uv.empty()) {
            make_tangents(mesh, uv);
            return;
        }
        mesh.tangents.resize(mesh.positions.size());
        for (std::size_t v = 0; v < mesh.tangents.size(); ++v)
            mesh.tangents[v] = glm::vec4(any_tangent(mesh.normals[v]), 1.0f);
    }
    void check_texture_coordinates(const GltfValue& primitive, const Material& look, const Mesh& mesh) {
        for (const TextureRef* use : {&look.base_color_texture, &look.metallic_roughness_texture, &look.normal_texture,
                                      &look.occlusion_texture, &look.emissive_texture})
            if (use->used() && (use->uv_set == 0 ? mesh.uv0 : mesh.uv1).empty()) {
                warn(primitive, "its material samples texture coordinates that it lacks (TEXCOORD_" +
                                    std::to_string(use->uv_set) + "): (0, 0) is used");
                return;
            }
    }

    const GltfData& data_;
    Scene& scene_;
    GltfBudget& budget_;
    bool quantization_;
    bool warned_morph_ = false;
};

}  // namespace pellucid::inline v0_1::detail
