// SPDX-License-Identifier: MIT
/// \file
/// What the loader makes of valid files: topologies, attributes, materials, hierarchy, cameras, lights.
#include <pellucid/scene/gltf.hpp>
#include <glm/geometric.hpp>
#include "scene/gltf_text.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

/// A document with five vertices whose POSITION is (i, i², 0), `primitive` added to its attributes' object's end.
std::string five(const std::string& primitive, const std::string& accessors = {}, const std::string& views = {},
                 const std::string& more = {}) {
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0)" +
           primitive + R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})" +
           accessors + R"(],"bufferViews":[{"buffer":0,"byteLength":60})" + views +
           R"(],"buffers":[{"byteLength":200}])" + more + "}";
}
std::string five_bin(const std::string& more = {}) {
    std::string bin;
    for (int i = 0; i < 5; ++i) bin += bytes_of({static_cast<float>(i), static_cast<float>(i * i), 0.0f});
    bin += more;
    bin.resize(200, '\0');
    return bin;
}

Scene load(const std::string& json, const std::string& bin) {
    auto scene = load_parts(json, bin);
    INFO((scene ? std::string() : scene.error().message));
    REQUIRE(scene);
    return std::move(*scene);
}

/// The x of every corner, in order.
std::vector<int> corners(const Mesh& mesh) {
    std::vector<int> list;
    for (const std::uint32_t i : mesh.indices) list.push_back(static_cast<int>(mesh.positions[i].x));
    return list;
}

}  // namespace

TEST_CASE("lists, strips and fans become triangles with their winding", "[cpu][gltf]") {
    const Scene list = load(five("}"), five_bin());
    CHECK(corners(list.meshes[0]) == std::vector{0, 1, 2});
    REQUIRE(list.warnings.size() == 1);
    CHECK(list.warnings[0] == "/meshes/0/primitives/0: 5 indices are no multiple of 3: the rest is left out");
    CHECK(corners(load(five(R"(},"mode":5)"), five_bin()).meshes[0]) == std::vector{0, 1, 2, 1, 3, 2, 2, 3, 4});
    CHECK(corners(load(five(R"(},"mode":6)"), five_bin()).meshes[0]) == std::vector{1, 2, 0, 2, 3, 0, 3, 4, 0});
    for (const char* mode : {"0", "1", "2", "3"}) {
        const Scene lines = load(five(std::string(R"(},"mode":)") + mode), five_bin());
        CHECK(lines.meshes.empty());
        CHECK(lines.instances.empty());
        REQUIRE(lines.warnings.size() == 1);
    }
}

TEST_CASE("without normals each triangle has its own flat one", "[cpu][gltf]") {
    const Scene scene = load(five(R"(},"mode":5)"), five_bin());
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.positions.size() == 9);
    // The points turn left: a strip's second triangle, whose winding alternates, is seen from behind.
    for (std::size_t i = 0; i < 9; ++i) CHECK(mesh.normals[i].z == (i / 3 == 1 ? -1.0f : 1.0f));
}

TEST_CASE("vertices that no index uses are left out, the others keep their order", "[cpu][gltf]") {
    std::string normals;
    for (int i = 0; i < 5; ++i) normals += bytes_of({0.0f, 0.0f, 2.0f});
    const std::string bin = five_bin(normals + bytes_of<std::uint8_t>({4, 1, 3, 3, 1, 4}));
    const Scene scene = load(
        five(
            R"(,"NORMAL":1},"indices":2)",
            R"(,{"bufferView":1,"componentType":5126,"count":5,"type":"VEC3"},{"bufferView":2,"componentType":5121,"count":6,"type":"SCALAR"})",
            R"(,{"buffer":0,"byteOffset":60,"byteLength":60},{"buffer":0,"byteOffset":120,"byteLength":6})"),
        bin);
    const Mesh& mesh = scene.meshes[0];
    REQUIRE(mesh.positions.size() == 3);
    CHECK(mesh.positions[0].x == 1);
    CHECK(mesh.positions[2].x == 4);
    CHECK(corners(mesh) == std::vector{4, 1, 3, 3, 1, 4});
    CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));  // made unit
    CHECK(mesh.upper == glm::vec3(4, 16, 0));
}

TEST_CASE("colours and texture coordinates of every type", "[cpu][gltf]") {
    const std::string views = R"(,{"buffer":0,"byteOffset":60,"byteLength":120,"byteStride":8})";
    const auto attribute = [&](const char* name, const char* accessor, const std::string& data) {
        return load(five(std::string(",\"") + name + "\":1}",
                         std::string(R"(,{"bufferView":1,"count":5,)") + accessor + "}", views),
                    five_bin(data));
    };
    const Scene u8 = attribute("COLOR_0", R"("componentType":5121,"normalized":true,"type":"VEC4")",
                               bytes_of<std::uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 0, 255, 0, 255}));
    CHECK(u8.meshes[0].colors[0] == glm::vec4(1, 0, 0.2f, 0.4f));
    CHECK(u8.meshes[0].colors[1] == glm::vec4(0, 1, 0, 1));
    const Scene u16 = attribute("COLOR_0", R"("componentType":5123,"normalized":true,"type":"VEC3")",
                                bytes_of<std::uint16_t>({65535, 0, 13107, 0}));
    CHECK(u16.meshes[0].colors[0] == glm::vec4(1, 0, 0.2f, 1));
    const Scene uv = attribute("TEXCOORD_1", R"("componentType":5123,"normalized":true,"type":"VEC2")",
                               bytes_of<std::uint16_t>({65535, 13107}));
    CHECK(uv.meshes[0].uv1[0] == glm::vec2(1, 0.2f));
    CHECK(uv.meshes[0].uv0.empty());
    const Scene uv_f32 = attribute("TEXCOORD_0", R"("componentType":5126,"type":"VEC2")", bytes_of({-2.5f, 3.5f}));
    CHECK(uv_f32.meshes[0].uv0[0] == glm::vec2(-2.5f, 3.5f));
    // Integers that are not normalised are no texture coordinates, without the extension.
    const std::string raw =
        five(R"(,"TEXCOORD_0":1})", R"(,{"bufferView":1,"count":5,"componentType":5122,"type":"VEC2"})", views);
    CHECK(refusal(raw, five_bin()).find("which TEXCOORD_0 may not be") != std::string::npos);
    const Scene quantized = load(with(raw, R"("asset")", R"("extensionsRequired":["KHR_mesh_quantization"],"asset")"),
                                 five_bin(bytes_of<std::int16_t>({-7, 9})));
    CHECK(quantized.meshes[0].uv0[0] == glm::vec2(-7, 9));
}

TEST_CASE("materials: factors, modes, extensions", "[cpu][gltf]") {
    const std::string material = R"(,"extensionsUsed":["KHR_materials_unlit","KHR_materials_emissive_strength"],
        "materials":[{"name":"a"},{"name":"b","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,
        "emissiveFactor":[1,0.5,0],"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0,
        "roughnessFactor":0.5},"extensions":{"KHR_materials_unlit":{},"KHR_materials_emissive_strength":{"emissiveStrength":6}}},
        {"alphaMode":"BLEND"}])";
    const Scene scene = load(five(R"(},"material":1)", {}, {}, material), five_bin());
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.meshes[0].material == 1);
    const Material& a = scene.materials[0];
    CHECK((a.base_color == glm::vec4(1) && a.metallic == 1 && a.roughness == 1 && !a.unlit && !a.double_sided));
    CHECK(a.alpha_mode == AlphaMode::opaque);
    const Material& b = scene.materials[1];
    CHECK(b.name == "b");
    CHECK(b.base_color == glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    CHECK((b.metallic == 0 && b.roughness == 0.5f && b.unlit && b.double_sided && b.alpha_cutoff == 0.25f));
    CHECK(b.alpha_mode == AlphaMode::mask);
    CHECK(b.emissive == glm::vec3(6, 3, 0));
    CHECK(scene.materials[2].alpha_mode == AlphaMode::blend);
    CHECK(scene.warnings.size() == 1);  // five vertices are no multiple of three
}

TEST_CASE("textures: samplers, transforms, only pictures that are shown", "[cpu][gltf]") {
    const std::string png =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/"
        "AfAAQAAf+I0P3MAAAAAElFTkSuQmCC";
    const std::string material =
        R"(,"extensionsUsed":["KHR_texture_transform"],"images":[{"uri":"gone.png"},{"name":"dot","uri":")" + png +
        R"("}],"samplers":[{"minFilter":9985,"magFilter":9728,"wrapS":33071,"wrapT":33648},{"minFilter":9728}],
        "textures":[{"source":0},{"source":1,"sampler":0},{"source":1,"sampler":1},{"source":1}],
        "materials":[{"normalTexture":{"index":1,"scale":0.5,"texCoord":1},"occlusionTexture":{"index":2,"strength":0.25},
        "emissiveTexture":{"index":3,"texCoord":5},"pbrMetallicRoughness":{"baseColorTexture":{"index":1,"extensions":
        {"KHR_texture_transform":{"offset":[0.5,1],"scale":[2,-1],"rotation":1,"texCoord":0}}}}}])";
    const Scene scene = load(five(R"(},"material":0)", {}, {}, material), five_bin());
    REQUIRE(scene.images.size() == 1);
    CHECK(scene.images[0].name == "dot");
    CHECK(scene.images[0].pixels.channels == 4);
    REQUIRE(scene.textures.size() == 3);
    const Material& m = scene.materials[0];
    CHECK(m.base_color_texture.texture == m.normal_texture.texture);
    CHECK(m.base_color_texture.offset == glm::vec2(0.5f, 1));
    CHECK(m.base_color_texture.scale == glm::vec2(2, -1));
    CHECK(m.base_color_texture.rotation == 1);
    CHECK((m.normal_texture.uv_set == 1 && m.normal_scale == 0.5f && m.occlusion_strength == 0.25f));
    CHECK_FALSE(m.emissive_texture.used());  // texture coordinates 5
    const TextureSampler& s = scene.textures[m.normal_texture.texture].sampler;
    CHECK((s.min == TextureFilter::linear && s.mip == TextureFilter::nearest && s.mag == TextureFilter::nearest));
    CHECK((s.mipmapped && s.wrap_u == TextureWrap::clamp && s.wrap_v == TextureWrap::mirror));
    CHECK_FALSE(scene.textures[m.occlusion_texture.texture].sampler.mipmapped);
    // The normal map's texture coordinates are missing: any tangent will do, and a warning says so.
    CHECK(scene.meshes[0].tangents.size() == scene.meshes[0].positions.size());
    CHECK(scene.warnings.size() == 3);
}

TEST_CASE("the hierarchy is multiplied in double, depth first in file order", "[cpu][gltf]") {
    const std::string nodes = R"("nodes":[{"mesh":0,"translation":[1e8,0,0],"children":[2,1]},{"mesh":0},
        {"mesh":0,"translation":[0.001,0,0],"scale":[-1,2,3],"children":[3]},
        {"mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476]},{"mesh":0}],"scene":1,"scenes":[{"nodes":[4]},{"nodes":[4,0]}])";
    const Scene scene = load(with(triangle_json, R"("scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}])",
                                  nodes),
                             triangle_bin());
    REQUIRE(scene.instances.size() == 5);
    CHECK(scene.instances[0].world_from_object == glm::dmat4(1.0));                      // node 4
    CHECK(scene.instances[1].world_from_object[3] == glm::dvec4(1e8, 0, 0, 1));          // node 0
    CHECK(scene.instances[2].world_from_object[3] == glm::dvec4(1e8 + 0.001, 0, 0, 1));  // node 2
    CHECK(scene.instances[2].world_from_object[0] == glm::dvec4(-1, 0, 0, 0));
    CHECK(glm::length(scene.instances[3].world_from_object[0] - glm::dvec4(0, 0, -3, 0)) < 1e-12);  // node 3
    CHECK(scene.instances[4].world_from_object[3] == glm::dvec4(1e8, 0, 0, 1));                     // node 1
}

TEST_CASE("cameras and lights are placed rigidly", "[cpu][gltf]") {
    const std::string more = R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"spot","intensity":7,"color":[1,0.5,0.25],"range":9,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
        {"type":"directional","range":5},{"type":"point"}]}},
        "cameras":[{"type":"perspective","name":"eye","perspective":{"yfov":1,"znear":0.5,"zfar":10}},
        {"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":4}}],
        "nodes":[{"scale":[2,3,4],"translation":[1,2,3],"camera":0,"children":[1,2]},
        {"name":"lamp","rotation":[0.7071067811865476,0,0,0.7071067811865476],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"camera":1,"children":[3,4]},{"extensions":{"KHR_lights_punctual":{"light":1}}},
        {"extensions":{"KHR_lights_punctual":{"light":2}}}])";
    const Scene scene = load(with(triangle_json, R"("nodes":[{"mesh":0}])", more), triangle_bin());
    REQUIRE(scene.cameras.size() == 2);
    const Camera& eye = scene.cameras[0];
    CHECK((eye.name == "eye" && eye.vertical_fov == 1 && eye.near == 0.5));
    CHECK(eye.world_from_view[0] == glm::dvec4(1, 0, 0, 0));
    CHECK(eye.world_from_view[3] == glm::dvec4(1, 2, 3, 1));
    const Camera& flat = scene.cameras[1];
    CHECK((flat.projection == Projection::orthographic && flat.half_width == 2 && flat.half_height == 3 &&
           flat.far == 4));
    REQUIRE(scene.lights.size() == 3);
    CHECK(check_lights(scene.lights));
    const Light& spot = scene.lights[0];
    CHECK((spot.kind == LightKind::spot && spot.name == "lamp" && spot.intensity == 7 && spot.range == 9));
    CHECK((spot.inner_cone == 0.1 && spot.outer_cone == 0.2));
    CHECK(spot.color == glm::vec3(1, 0.5f, 0.25f));
    CHECK(spot.position == glm::dvec3(1, 2, 3));
    CHECK(glm::length(spot.direction - glm::dvec3(0, 1, 0)) < 1e-12);  // -z turned a quarter about x
    CHECK((scene.lights[1].kind == LightKind::directional && scene.lights[1].range == 0));
    CHECK(scene.lights[1].direction == glm::dvec3(0, 0, -1));
    CHECK((scene.lights[2].kind == LightKind::point && scene.lights[2].range == 0 && scene.lights[2].intensity == 1));
}

TEST_CASE("a text file with a buffer beside it, escapes in its name", "[cpu][gltf]") {
    const TemporaryFolder folder;
    write_bytes(folder / "a b.bin", triangle_bin() + "more than byteLength");
    write_bytes(folder / "t.gltf", with(triangle_json, R"("byteLength":44)", R"("byteLength":44,"uri":"a%20b.bin")"));
    const auto scene = load_gltf(folder / "t.gltf");
    INFO((scene ? std::string() : scene.error().message));
    CHECK(scene);
}
