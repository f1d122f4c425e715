// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The format's rules for single values, as one table: which members an object has, their types, ranges, and the tables
/// they point into.  What has passed `gltf_check_schema` can be read without looking at types again.
#include <pellucid/scene/detail/gltf_json.hpp>
#include <cmath>
#include <limits>
#include <span>

namespace pellucid::inline v0_1::detail {

enum class GltfObject : std::uint8_t {
    root,
    asset,
    accessor,
    sparse,
    sparse_indices,
    sparse_values,
    buffer,
    buffer_view,
    image,
    texture,
    sampler,
    use,
    normal_use,
    occlusion_use,
    material,
    metallic_roughness,
    mesh,
    primitive,
    camera,
    perspective,
    orthographic,
    node,
    scene,
    animation,
    channel,
    target,
    animation_sampler,
    skin,
    root_extensions,
    lights,
    light,
    spot,
    node_extensions,
    node_light,
    material_extensions,
    emissive_strength,
    use_extensions,
    transform,
    empty
};

enum class GltfKind : std::uint8_t {
    boolean,
    integer,
    number,
    text,
    object,
    index,  ///< one value
    numbers,
    texts,
    objects,
    indices,  ///< an array of them
    index_map,
    index_maps  ///< an object whose values are indices; an array of those
};

/// What the value of a member must be.
struct GltfRule {
    bool required = false;
    double low = -std::numeric_limits<double>::infinity();  ///< of numbers, inclusive
    double high = std::numeric_limits<double>::infinity();
    std::size_t count = 0;  ///< of arrays: fewest values
    std::size_t most = std::numeric_limits<std::size_t>::max();
    GltfObject child = GltfObject::empty;  ///< of `object` and `objects`
    const char* table = nullptr;           ///< of indices: the root's array they point into
};

/// One member of an object.
struct GltfMember {
    GltfObject owner;
    const char* key;
    GltfKind kind;
    GltfRule rule = {};
};

// clang-format off
inline constexpr double gltf_huge = 9007199254740991.0;  // 2^53 - 1: integers up to here survive JSON
inline constexpr double gltf_quarter_turn = 1.5707963705062866;  // [rad] pi/2 rounded up to a float, as files have it
inline constexpr GltfMember gltf_members[] = {
    {GltfObject::root, "asset", GltfKind::object, {.required = true, .child = GltfObject::asset}},
    {GltfObject::root, "extensionsUsed", GltfKind::texts},
    {GltfObject::root, "extensionsRequired", GltfKind::texts},
    {GltfObject::root, "accessors", GltfKind::objects, {.child = GltfObject::accessor}},
    {GltfObject::root, "animations", GltfKind::objects, {.child = GltfObject::animation}},
    {GltfObject::root, "buffers", GltfKind::objects, {.child = GltfObject::buffer}},
    {GltfObject::root, "bufferViews", GltfKind::objects, {.child = GltfObject::buffer_view}},
    {GltfObject::root, "cameras", GltfKind::objects, {.child = GltfObject::camera}},
    {GltfObject::root, "images", GltfKind::objects, {.child = GltfObject::image}},
    {GltfObject::root, "materials", GltfKind::objects, {.child = GltfObject::material}},
    {GltfObject::root, "meshes", GltfKind::objects, {.child = GltfObject::mesh}},
    {GltfObject::root, "nodes", GltfKind::objects, {.child = GltfObject::node}},
    {GltfObject::root, "samplers", GltfKind::objects, {.child = GltfObject::sampler}},
    {GltfObject::root, "scene", GltfKind::index, {.table = "scenes"}},
    {GltfObject::root, "scenes", GltfKind::objects, {.child = GltfObject::scene}},
    {GltfObject::root, "skins", GltfKind::objects, {.child = GltfObject::skin}},
    {GltfObject::root, "textures", GltfKind::objects, {.child = GltfObject::texture}},
    {GltfObject::root, "extensions", GltfKind::object, {.child = GltfObject::root_extensions}},
    {GltfObject::asset, "version", GltfKind::text, {.required = true}},
    {GltfObject::asset, "minVersion", GltfKind::text},
    {GltfObject::accessor, "bufferView", GltfKind::index, {.table = "bufferViews"}},
    {GltfObject::accessor, "byteOffset", GltfKind::integer, {.low = 0, .high = gltf_huge}},
    {GltfObject::accessor, "componentType", GltfKind::integer, {.required = true, .low = 5120, .high = 5126}},
    {GltfObject::accessor, "normalized", GltfKind::boolean},
    {GltfObject::accessor, "count", GltfKind::integer, {.required = true, .low = 1, .high = gltf_huge}},
    {GltfObject::accessor, "type", GltfKind::text, {.required = true}},
    {GltfObject::accessor, "max", GltfKind::numbers, {.count = 1, .most = 16}},
    {GltfObject::accessor, "min", GltfKind::numbers, {.count = 1, .most = 16}},
    {GltfObject::accessor, "sparse", GltfKind::object, {.child = GltfObject::sparse}},
    {GltfObject::sparse, "count", GltfKind::integer, {.required = true, .low = 1, .high = gltf_huge}},
    {GltfObject::sparse, "indices", GltfKind::object, {.required = true, .child = GltfObject::sparse_indices}},
    {GltfObject::sparse, "values", GltfKind::object, {.required = true, .child = GltfObject::sparse_values}},
    {GltfObject::sparse_indices, "bufferView", GltfKind::index, {.required = true, .table = "bufferViews"}},
    {GltfObject::sparse_indices, "byteOffset", GltfKind::integer, {.low = 0, .high = gltf_huge}},
    {GltfObject::sparse_indices, "componentType", GltfKind::integer, {.required = true, .low = 5121, .high = 5125}},
    {GltfObject::sparse_values, "bufferView", GltfKind::index, {.required = true, .table = "bufferViews"}},
    {GltfObject::sparse_values, "byteOffset", GltfKind::integer, {.low = 0, .high = gltf_huge}},
    {GltfObject::buffer, "uri", GltfKind::text},
    {GltfObject::buffer, "byteLength", GltfKind::integer, {.required = true, .low = 1, .high = gltf_huge}},
    {GltfObject::buffer_view, "buffer", GltfKind::index, {.required = true, .table = "buffers"}},
    {GltfObject::buffer_view, "byteOffset", GltfKind::integer, {.low = 0, .high = gltf_huge}},
    {GltfObject::buffer_view, "byteLength", GltfKind::integer, {.required = true, .low = 1, .high = gltf_huge}},
    {GltfObject::buffer_view, "byteStride", GltfKind::integer, {.low = 4, .high = 252}},
    {GltfObject::image, "uri", GltfKind::text},
    {GltfObject::image, "mimeType", GltfKind::text},
    {GltfObject::image, "bufferView", GltfKind::index, {.table = "bufferViews"}},
    {GltfObject::image, "name", GltfKind::text},
    {GltfObject::texture, "sampler", GltfKind::index, {.table = "samplers"}},
    {GltfObject::texture, "source", GltfKind::index, {.table = "images"}},
    {GltfObject::sampler, "magFilter", GltfKind::integer, {.low = 9728, .high = 9729}},
    {GltfObject::sampler, "minFilter", GltfKind::integer, {.low = 9728, .high = 9987}},
    {GltfObject::sampler, "wrapS", GltfKind::integer, {.low = 10497, .high = 33648}},
    {GltfObject::sampler, "wrapT", GltfKind::integer, {.low = 10497, .high = 33648}},
    {GltfObject::use, "index", GltfKind::index, {.required = true, .table = "textures"}},
    {GltfObject::use, "texCoord", GltfKind::integer, {.low = 0, .high = 1e6}},
    {GltfObject::use, "extensions", GltfKind::object, {.child = GltfObject::use_extensions}},
    {GltfObject::normal_use, "scale", GltfKind::number},
    {GltfObject::occlusion_use, "strength", GltfKind::number, {.low = 0, .high = 1}},
    {GltfObject::use_extensions, "KHR_texture_transform", GltfKind::object, {.child = GltfObject::transform}},
    {GltfObject::transform, "offset", GltfKind::numbers, {.count = 2, .most = 2}},
    {GltfObject::transform, "rotation", GltfKind::number},
    {GltfObject::transform, "scale", GltfKind::numbers, {.count = 2, .most = 2}},
    {GltfObject::transform, "texCoord", GltfKind::integer, {.low = 0, .high = 1e6}},
    {GltfObject::material, "name", GltfKind::text},
    {GltfObject::material, "pbrMetallicRoughness", GltfKind::object, {.child = GltfObject::metallic_roughness}},
    {GltfObject::material, "normalTexture", GltfKind::object, {.child = GltfObject::normal_use}},
    {GltfObject::material, "occlusionTexture", GltfKind::object, {.child = GltfObject::occlusion_use}},
    {GltfObject::material, "emissiveTexture", GltfKind::object, {.child = GltfObject::use}},
    {GltfObject::material, "emissiveFactor", GltfKind::numbers, {.low = 0, .high = 1, .count = 3, .most = 3}},
    {GltfObject::material, "alphaMode", GltfKind::text},
    {GltfObject::material, "alphaCutoff", GltfKind::number, {.low = 0}},
    {GltfObject::material, "doubleSided", GltfKind::boolean},
    {GltfObject::material, "extensions", GltfKind::object, {.child = GltfObject::material_extensions}},
    {GltfObject::material_extensions, "KHR_materials_emissive_strength", GltfKind::object, {.child = GltfObject::emissive_strength}},
    {GltfObject::material_extensions, "KHR_materials_unlit", GltfKind::object},
    {GltfObject::emissive_strength, "emissiveStrength", GltfKind::number, {.low = 0}},
    {GltfObject::metallic_roughness, "baseColorFactor", GltfKind::numbers, {.low = 0, .high = 1, .count = 4, .most = 4}},
    {GltfObject::metallic_roughness, "baseColorTexture", GltfKind::object, {.child = GltfObject::use}},
    {GltfObject::metallic_roughness, "metallicFactor", GltfKind::number, {.low = 0, .high = 1}},
    {GltfObject::metallic_roughness, "roughnessFactor", GltfKind::number, {.low = 0, .high = 1}},
    {GltfObject::metallic_roughness, "metallicRoughnessTexture", GltfKind::object, {.child = GltfObject::use}},
    {GltfObject::mesh, "name", GltfKind::text},
    {GltfObject::mesh, "primitives", GltfKind::objects, {.required = true, .child = GltfObject::primitive}},
    {GltfObject::mesh, "weights", GltfKind::numbers},
    {GltfObject::primitive, "attributes", GltfKind::index_map, {.required = true, .table = "accessors"}},
    {GltfObject::primitive, "indices", GltfKind::index, {.table = "accessors"}},
    {GltfObject::primitive, "material", GltfKind::index, {.table = "materials"}},
    {GltfObject::primitive, "mode", GltfKind::integer, {.low = 0, .high = 6}},
    {GltfObject::primitive, "targets", GltfKind::index_maps, {.table = "accessors"}},
    {GltfObject::camera, "name", GltfKind::text},
    {GltfObject::camera, "type", GltfKind::text, {.required = true}},
    {GltfObject::camera, "perspective", GltfKind::object, {.child = GltfObject::perspective}},
    {GltfObject::camera, "orthographic", GltfKind::object, {.child = GltfObject::orthographic}},
    {GltfObject::perspective, "aspectRatio", GltfKind::number, {.low = 1e-30}},
    {GltfObject::perspective, "yfov", GltfKind::number, {.required = true, .low = 1e-9}},
    {GltfObject::perspective, "zfar", GltfKind::number, {.low = 1e-30}},
    {GltfObject::perspective, "znear", GltfKind::number, {.required = true, .low = 1e-30}},
    {GltfObject::orthographic, "xmag", GltfKind::number, {.required = true}},
    {GltfObject::orthographic, "ymag", GltfKind::number, {.required = true}},
    {GltfObject::orthographic, "zfar", GltfKind::number, {.required = true, .low = 1e-30}},
    {GltfObject::orthographic, "znear", GltfKind::number, {.required = true, .low = 0}},
    {GltfObject::node, "name", GltfKind::text},
    {GltfObject::node, "camera", GltfKind::index, {.table = "cameras"}},
    {GltfObject::node, "children", GltfKind::indices, {.table = "nodes"}},
    {GltfObject::node, "skin", GltfKind::index, {.table = "skins"}},
    {GltfObject::node, "mesh", GltfKind::index, {.table = "meshes"}},
    {GltfObject::node, "matrix", GltfKind::numbers, {.count = 16, .most = 16}},
    {GltfObject::node, "rotation", GltfKind::numbers, {.low = -1, .high = 1, .count = 4, .most = 4}},
    {GltfObject::node, "scale", GltfKind::numbers, {.count = 3, .most = 3}},
    {GltfObject::node, "translation", GltfKind::numbers, {.count = 3, .most = 3}},
    {GltfObject::node, "weights", GltfKind::numbers},
    {GltfObject::node, "extensions", GltfKind::object, {.child = GltfObject::node_extensions}},
    {GltfObject::node_extensions, "KHR_lights_punctual", GltfKind::object, {.child = GltfObject::node_light}},
    {GltfObject::node_light, "light", GltfKind::integer, {.required = true, .low = 0, .high = gltf_huge}},
    {GltfObject::scene, "nodes", GltfKind::indices, {.table = "nodes"}},
    {GltfObject::scene, "name", GltfKind::text},
    {GltfObject::root_extensions, "KHR_lights_punctual", GltfKind::object, {.child = GltfObject::lights}},
    {GltfObject::lights, "lights", GltfKind::objects, {.required = true, .child = GltfObject::light}},
    {GltfObject::light, "type", GltfKind::text, {.required = true}},
    {GltfObject::light, "name", GltfKind::text},
    {GltfObject::light, "color", GltfKind::numbers, {.low = 0, .high = 1, .count = 3, .most = 3}},
    {GltfObject::light, "intensity", GltfKind::number, {.low = 0}},
    {GltfObject::light, "range", GltfKind::number, {.low = 1e-30}},
    {GltfObject::light, "spot", GltfKind::object, {.child = GltfObject::spot}},
    {GltfObject::spot, "innerConeAngle", GltfKind::number, {.low = 0, .high = gltf_quarter_turn}},
    {GltfObject::spot, "outerConeAngle", GltfKind::number, {.low = 1e-9, .high = gltf_quarter_turn}},
    {GltfObject::animation, "channels", GltfKind::objects, {.required = true, .child = GltfObject::channel}},
    {GltfObject::animation, "samplers", GltfKind::objects, {.required = true, .child = GltfObject::animation_sampler}},
    {GltfObject::channel, "sampler", GltfKind::integer, {.required = true, .low = 0, .high = gltf_huge}},
    {GltfObject::channel, "target", GltfKind::object, {.required = true, .child = GltfObject::target}},
    {GltfObject::target, "node", GltfKind::index, {.table = "nodes"}},
    {GltfObject::target, "path", GltfKind::text, {.required = true}},
    {GltfObject::animation_sampler, "input", GltfKind::index, {.required = true, .table = "accessors"}},
    {GltfObject::animation_sampler, "output", GltfKind::index, {.required = true, .table = "accessors"}},
    {GltfObject::animation_sampler, "interpolation", GltfKind::text},
    {GltfObject::skin, "inverseBindMatrices", GltfKind::index, {.table = "accessors"}},
    {GltfObject::skin, "skeleton", GltfKind::index, {.table = "nodes"}},
    {GltfObject::skin, "joints", GltfKind::indices, {.required = true, .count = 1, .table = "nodes"}},
};
// clang-format on

/// A texture use with a scale or a strength has the members of a plain one too.
[[nodiscard]] constexpr bool gltf_owns(GltfObject owner, GltfObject object) noexcept {
    return owner == object ||
           (owner == GltfObject::use && (object == GltfObject::normal_use || object == GltfObject::occlusion_use));
}

class GltfSchema {
public:
    explicit GltfSchema(Json& root) : root_(root) {}

    /// Checks `value` and everything below it against the table.  Afterwards every integer is stored as one (files may
    /// say 1.0), every other number as a float, and members that the table does not name are gone.
    void check(const GltfValue& value, GltfObject object) const {
        if (!value.json().is_object()) value.fail("must be an object, is " + describe(value.json()));
        for (const GltfMember& member : gltf_members) {
            if (!gltf_owns(member.owner, object)) continue;
            if (value.has(member.key))
                check_member(value[member.key], member);
            else if (member.rule.required)
                value.fail("lacks the required member \"" + std::string(member.key) + "\"");
        }
        Json& json = value.json();
        for (auto item = json.begin(); item != json.end();)
            item = names(object, item.key()) ? ++item : json.erase(item);
    }

private:
    static bool names(GltfObject object, const std::string& key) {
        for (const GltfMember& member : gltf_members)
            if (gltf_owns(member.owner, object) && key == member.key) return true;
        return false;
    }
    static std::string describe(const Json& json) {
        if (json.is_structured() || json.is_null()) return std::string(json.type_name());
        std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
        return text.size() > 60 ? text.substr(0, 60) + "..." : text;
    }
    static void check_number(const GltfValue& value, const GltfMember& member) {
        Json& json = value.json();
        if (!json.is_number()) value.fail("must be a number, is " + describe(json));
        const double number = json.get<double>();
        // A float must hold it too: everything that is not an integer ends as one.
        if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max())))
            value.fail("is " + describe(json) + ", which no 32-bit float holds");
        check_range(value, number, member);
        json = number;
    }
    static void check_range(const GltfValue& value, double number, const GltfMember& member) {
        if (number < member.rule.low || number > member.rule.high) {
            const auto bound = [](double d) { return Json(d).dump(); };
            value.fail("is " + describe(value.json()) + ", outside the range " +
                       (std::isinf(member.rule.low) ? "(-inf" : "[" + bound(member.rule.low)) + ", " +
                       (std::isinf(member.rule.high) ? "inf)" : bound(member.rule.high) + "]"));
        }
    }
    static void check_integer(const GltfValue& value, const GltfMember& member) {
        Json& json = value.json();
        if (json.is_number_float()) {
            const double number = json.get<double>();
            if (std::floor(number) == number && std::abs(number) <= gltf_huge) json = static_cast<std::int64_t>(number);
        }
        if (!json.is_number_integer()) value.fail("must be an integer, is " + describe(json));
        check_range(value, json.get<double>(), member);
        if (json.is_number_unsigned()) return;
        if (json.get<std::int64_t>() >= 0) json = static_cast<std::uint64_t>(json.get<std::int64_t>());
    }
    void check_index(const GltfValue& value, const GltfMember& member) const {
        const GltfMember range{member.owner, member.key, GltfKind::integer, {.low = 0, .high = gltf_huge}};
        check_integer(value, range);
        const auto table = root_.find(member.rule.table);
        const std::size_t size = table != root_.end() && table->is_array() ? table->size() : 0;
        if (value.json().get<std::uint64_t>() >= size)
            value.fail("is " + describe(value.json()) + ", but /" + member.rule.table + " has " + std::to_string(size) +
                       " entries");
    }
    void check_index_map(const GltfValue& value, const GltfMember& member) const {
        if (!value.json().is_object()) value.fail("must be an object, is " + describe(value.json()));
        for (auto& [key, index] : value.json().items())
            check_index({index, value.pointer() + "/" + GltfValue::escape(key)}, member);
    }
    void check_member(const GltfValue& value, const GltfMember& member) const {
        const Json& json = value.json();
        switch (member.kind) {
            case GltfKind::boolean:
                if (!json.is_boolean()) value.fail("must be true or false, is " + describe(json));
                return;
            case GltfKind::text:
                if (!json.is_string()) value.fail("must be a string, is " + describe(json));
                return;
            case GltfKind::integer:
                return check_integer(value, member);
            case GltfKind::number:
                return check_number(value, member);
            case GltfKind::object:
                return check(value, member.rule.child);
            case GltfKind::index:
                return check_index(value, member);
            case GltfKind::index_map:
                return check_index_map(value, member);
            default:
                break;
        }
        if (!json.is_array()) value.fail("must be an array, is " + describe(json));
        if (json.size() < member.rule.count || json.size() > member.rule.most)
            value.fail("has " + std::to_string(json.size()) + " values, must have " +
                       std::to_string(member.rule.count) + (member.rule.most > member.rule.count ? " or more" : ""));
        for (std::size_t i = 0; i < json.size(); ++i) {
            switch (member.kind) {
                case GltfKind::numbers:
                    check_number(value[i], member);
                    break;
                case GltfKind::texts:
                    if (!json[i].is_string()) value[i].fail("must be a string, is " + describe(json[i]));
                    break;
                case GltfKind::objects:
                    check(value[i], member.rule.child);
                    break;
                case GltfKind::indices:
                    check_index(value[i], member);
                    break;
                default:
                    check_index_map(value[i], member);
                    break;
            }
        }
    }

    Json& root_;
};

}  // namespace pellucid::inline v0_1::detail
