// SPDX-License-Identifier: MIT
/// \file
/// Files that are wrong in one way each: refused with a sentence that names the place and the value.
#include "scene/gltf_text.hpp"
#include <limits>
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

struct Case {
    const char* from;
    const char* to;
    const char* says;  ///< the start of the refusal
};

void check(const Case& wrong, const std::string& bin = triangle_bin()) {
    INFO(wrong.from << " -> " << wrong.to);
    const std::string says = refusal(with(triangle_json, wrong.from, wrong.to), bin);
    CHECK(says.substr(0, std::string(wrong.says).size()) == wrong.says);
    CHECK(says.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("the document that the others spoil is valid", "[cpu][gltf]") {
    const auto scene = load_parts(triangle_json);
    REQUIRE(scene);
    REQUIRE(scene->meshes.size() == 1);
    CHECK(scene->meshes[0].positions.size() == 3);
    CHECK(scene->meshes[0].normals[2] == glm::vec3(0, 0, 1));
    CHECK(scene->meshes[0].upper == glm::vec3(1, 1, 0));
    CHECK(scene->instances.size() == 1);
    CHECK(scene->materials.size() == 1);
    CHECK(scene->warnings.empty());
}

TEST_CASE("byte ranges that wrap or leave their view are refused", "[cpu][gltf]") {
    const Case wrong[] = {
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":9223372036854775808,"componentType":5126)",
         "/accessors/0/byteOffset: is 9223372036854775808, outside the range"},
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":18446744073709551580,"componentType":5126)",
         "/accessors/0/byteOffset: is 18446744073709551580, outside"},
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":9007199254740988,"componentType":5126)",
         "/accessors/0: 3 elements of 12 bytes at byteOffset 9007199254740988"},
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":-4,"componentType":5126)",
         "/accessors/0/byteOffset: is -4, outside"},
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":2,"componentType":5126)",
         "/accessors/0: byteOffset 2 in /bufferViews/0 is not aligned"},
        {R"("byteOffset":0,"componentType":5126)", R"("byteOffset":4,"componentType":5126)",
         "/accessors/0: 3 elements of 12 bytes at byteOffset 4"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":0)", "/accessors/0/count: is 0, outside"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":4)",
         "/accessors/0: 4 elements of 12 bytes"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":768614336404564651)",
         "/accessors/0/count: is 768614336404564651, outside"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":9007199254740991)",
         "/accessors/0: 9007199254740991 elements"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":3.5)",
         "/accessors/0/count: must be an integer, is 3.5"},
        {R"("componentType":5126,"count":3)", R"("componentType":5126,"count":1e300)",
         "/accessors/0/count: must be an integer, is 1e+300"},
        {R"("byteOffset":36,"byteLength":6)", R"("byteOffset":36,"byteLength":9)",
         "/bufferViews/1: byteOffset 36 + byteLength 9 is beyond the 44 bytes"},
        {R"("byteOffset":36,"byteLength":6)", R"("byteOffset":9007199254740991,"byteLength":9007199254740991)",
         "/bufferViews/1: byteOffset 9007199254740991"},
        {R"("byteLength":36})", R"("byteLength":36,"byteStride":8})",
         "/accessors/0: elements have 12 bytes, the byteStride"},
        {R"("byteLength":36})", R"("byteLength":36,"byteStride":16})", "/accessors/0: 3 elements of 12 bytes"},
        {R"("byteLength":36})", R"("byteLength":36,"byteStride":13})",
         "/bufferViews/0: byteStride 13 is no multiple of 4"},
        {R"("byteLength":36})", R"("byteLength":36,"byteStride":256})", "/bufferViews/0/byteStride: is 256, outside"},
        {R"([{"byteLength":44}])", R"([{"byteLength":45}])", "/buffers/0: byteLength is 45, its data has 44 bytes"},
        {R"([{"byteLength":44}])", R"([{"byteLength":44,"uri":"none.bin"}])", "/buffers/0/uri: "},
        {R"([{"byteLength":44}])", R"([{"byteLength":44,"uri":"/etc/passwd"}])",
         "/buffers/0/uri: is \"/etc/passwd\", which is no relative path"},
        {R"([{"byteLength":44}])", R"([{"byteLength":44,"uri":"file:///etc/passwd"}])", "/buffers/0/uri: is \"file:"},
        {R"([{"byteLength":44}])", R"([{"byteLength":44,"uri":"data:;base64,A*=="}])",
         "/buffers/0/uri: is a data URI whose base64"},
        {R"([{"byteLength":44}])", R"([{"byteLength":44,"uri":"data:;base64,AAAA"}])",
         "/buffers/0: byteLength is 44, its data has 3 bytes"}};
    for (const Case& one : wrong) check(one);
}

TEST_CASE("references and types are checked before use", "[cpu][gltf]") {
    const Case wrong[] = {
        {R"("POSITION":0)", R"("POSITION":2)",
         "/meshes/0/primitives/0/attributes/POSITION: is 2, but /accessors has 2"},
        {R"("POSITION":0)", R"("POSITION":-1)", "/meshes/0/primitives/0/attributes/POSITION: is -1, outside"},
        {R"("POSITION":0)", R"("POSITION":"0")", "/meshes/0/primitives/0/attributes/POSITION: must be an integer"},
        {R"("POSITION":0)", R"("POSITION":0,"NORMAL":1)",
         "/meshes/0/primitives/0/attributes/NORMAL: the accessor is SCALAR"},
        {R"("indices":1)", R"("indices":0)", "/meshes/0/primitives/0/indices: the accessor is VEC3"},
        {R"("indices":1)", R"("indices":1,"material":0)",
         "/meshes/0/primitives/0/material: is 0, but /materials has 0"},
        {R"("indices":1)", R"("indices":1,"mode":7)", "/meshes/0/primitives/0/mode: is 7, outside"},
        {R"({"mesh":0})", R"({"mesh":1})", "/nodes/0/mesh: is 1, but /meshes has 1 entries"},
        {R"({"mesh":0})", R"({"mesh":0,"children":[0]})", "/nodes/0: is its own ancestor"},
        {R"([{"mesh":0}])", R"([{"children":[1]},{"children":[2]},{"children":[1]}])",
         "/nodes/2/children/0: is node 1, which already is a child of node 0"},
        {R"([{"mesh":0}])", R"([{},{"children":[2]},{"children":[1]}])", "/nodes/1: is its own ancestor"},
        {R"([{"mesh":0}])", R"([{"children":[1,1]},{}])", "/nodes/0/children/1: is node 1, which already"},
        {R"("nodes":[0])", R"("nodes":[0,0])", "/scenes/0/nodes/1: node 0 is listed twice"},
        {R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,0,0]})", "/nodes/0/rotation: its length is 0"},
        {R"({"mesh":0})", R"({"mesh":0,"rotation":[0,0,1]})", "/nodes/0/rotation: has 3 values, must have 4"},
        {R"({"mesh":0})", R"({"mesh":0,"scale":[1e39,1,1]})", "/nodes/0/scale/0: is 1e+39, which no 32-bit float"},
        {R"({"mesh":0})", R"({"mesh":0,"scale":[null,1,1]})", "/nodes/0/scale/0: must be a number, is null"},
        {R"({"mesh":0})", R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]})", "/nodes/0/matrix: its last row"},
        {R"("scene":0)", R"("scene":1)", "/scene: is 1, but /scenes has 1"},
        {R"("version":"2.0")", R"("version":"1.0")", "/asset/version: is 1.0, only glTF 2"},
        {R"("scene":0)", R"("scene":0,"extensionsRequired":["EXT_nobody"])",
         "/extensionsRequired/0: the file cannot be shown without the extension EXT_nobody"},
        {R"("scene":0)", R"("scene":0,"materials":[{"alphaMode":"GLASS"}])", "/materials/0/alphaMode: is \"GLASS\""},
        {R"("scene":0)", R"("scene":0,"materials":[{"pbrMetallicRoughness":{"metallicFactor":1.5}}])",
         "/materials/0/pbrMetallicRoughness/metallicFactor: is 1.5, outside the range [0.0, 1.0]"},
        {R"("scene":0)", R"("scene":0,"samplers":[{"wrapS":10498}],"textures":[{"sampler":0,"source":0}],
            "images":[{"uri":"x.png"}],"materials":[{"emissiveTexture":{"index":0}}])",
         "/samplers/0/wrapS: is 10498"},
        {R"("scene":0)", R"("scene":0,"textures":[{"source":0}],
            "images":[{"uri":"x.png"}],"materials":[{"emissiveTexture":{"index":0}}])",
         "/images/0/uri: "},
        {R"("scene":0)", R"("scene":0,"textures":[{"source":0}],
            "images":[{"uri":"data:,GIF89a"}],"materials":[{"emissiveTexture":{"index":0}}])",
         "/images/0: the 6 bytes are neither a PNG nor a JPEG"}};
    for (const Case& one : wrong) check(one);
}

TEST_CASE("lights out of range are refused with the light's place and the value", "[cpu][gltf]") {
    const auto document = [](const std::string& light) {
        return with(triangle_json, R"("scene":0)",
                    R"("scene":0,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":
                    {"lights":[{"type":"point"},)" +
                        light + "]}}");
    };
    const std::string spot = R"({"type":"spot","spot":{"innerConeAngle":)";
    struct {
        std::string light;
        const char* says;  ///< the start of the refusal, after the light's place
    } const wrong[] = {
        {R"({"type":"point","intensity":-1})", "/intensity: is -1, outside the range [0.0, inf)"},
        {R"({"type":"point","intensity":1e39})", "/intensity: is 1e+39, which no 32-bit float holds"},
        {R"({"type":"point","intensity":null})", "/intensity: must be a number, is null"},
        {R"({"type":"point","intensity":"NaN"})", "/intensity: must be a number, is \"NaN\""},
        {R"({"type":"point","color":[1,-0.5,1]})", "/color/1: is -0.5, outside the range [0.0, 1.0]"},
        {R"({"type":"point","color":[1,1]})", "/color: has 2 values, must have 3"},
        {R"({"type":"point","color":[1,null,1]})", "/color/1: must be a number, is null"},
        {R"({"type":"point","range":-2})", "/range: is -2, outside the range"},
        {R"({"type":"point","range":0})", "/range: is 0, outside the range"},
        {spot + R"(0.5,"outerConeAngle":0.25}})", "/spot: innerConeAngle 0.5"},
        {spot + R"(0.25,"outerConeAngle":0.25}})", "/spot: innerConeAngle 0.25"},
        {spot + "0.8}}", "/spot: innerConeAngle 0.8"},  // the outer one is pi/4 where the file says nothing
        {spot + R"(-0.1,"outerConeAngle":0.25}})", "/spot/innerConeAngle: is -0.1, outside the range"},
        {spot + R"(0,"outerConeAngle":1.58}})", "/spot/outerConeAngle: is 1.58, outside the range"},
        {spot + R"(0,"outerConeAngle":90}})", "/spot/outerConeAngle: is 90, outside the range"},
        {spot + R"(0,"outerConeAngle":0}})", "/spot/outerConeAngle: is 0, outside the range"},
        {R"({"type":"spot"})", ": is a spot, lacks the member \"spot\""},
        {R"({"type":"area"})", "/type: is \"area\", none of directional, point, spot"},
        {R"({"intensity":1})", ": lacks the required member \"type\""}};
    for (const auto& one : wrong) {
        INFO(one.light);
        const std::string says = refusal(document(one.light)), place = "/extensions/KHR_lights_punctual/lights/1";
        CHECK(says.substr(0, place.size() + std::string(one.says).size()) == place + one.says);
        CHECK(says.find('\n') == std::string::npos);
    }
    CHECK(refusal(document(R"({"type":"point","intensity":NaN})")).find("is not valid JSON") == 0);
    // A right angle that was rounded to float on its way is one.
    CHECK(refusal(document(spot + R"(0,"outerConeAngle":1.5707963705062866}})")) == "");
    const auto wide = load_parts(with(document(spot + R"(0,"outerConeAngle":1.5707963705062866}})"), R"({"mesh":0})",
                                      R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":1}}})"));
    REQUIRE(wide);
    CHECK(check_lights(wide->lights));
}

TEST_CASE("data that would reach the GPU is checked", "[cpu][gltf]") {
    std::string bin = triangle_bin();
    const auto put = [&](std::size_t at, auto value) { std::memcpy(bin.data() + at, &value, sizeof value); };
    SECTION("an index beyond the vertices") {
        put(38, std::uint16_t{3});
        CHECK(refusal(triangle_json, bin) ==
              "/meshes/0/primitives/0/indices: index 1 is 3, the primitive has 3 vertices");
    }
    SECTION("the value that restarts primitives") {
        put(40, std::uint16_t{0xFFFF});
        CHECK(refusal(triangle_json, bin).find("restarts primitives") != std::string::npos);
    }
    SECTION("a NaN position") {
        put(16, std::numeric_limits<float>::quiet_NaN());
        CHECK(refusal(triangle_json, bin).substr(0, 41) == "/accessors/0: component 1 of element 1 is");
    }
    SECTION("an infinite position") {
        put(0, -std::numeric_limits<float>::infinity());
        CHECK(refusal(triangle_json, bin).substr(0, 41) == "/accessors/0: component 0 of element 0 is");
    }
}

TEST_CASE("sparse accessors: order, range, and what a valid one does", "[cpu][gltf]") {
    const auto document = [](const std::string& count) {
        return with(with(with(triangle_json, R"("type":"VEC3",)",
                              R"("type":"VEC3","sparse":{"count":)" + count +
                                  R"(,"indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}},)"),
                         R"("byteLength":6}])", R"("byteLength":6},{"buffer":0,"byteOffset":44,"byteLength":2},
                         {"buffer":0,"byteOffset":48,"byteLength":24}])"),
                    R"("byteLength":44)", R"("byteLength":72)");
    };
    const auto bin = [](std::uint8_t a, std::uint8_t b, float x = 7.0f) {
        return triangle_bin() + bytes_of<std::uint8_t>({a, b, 0, 0}) + bytes_of({x, 0.0f, 0.0f, 0.0f, 9.0f, 0.0f});
    };
    const auto scene = load_parts(document("2"), bin(1, 2));
    REQUIRE(scene);
    CHECK(scene->meshes[0].positions[0] == glm::vec3(0, 0, 0));
    CHECK(scene->meshes[0].positions[1] == glm::vec3(7, 0, 0));
    CHECK(scene->meshes[0].positions[2] == glm::vec3(0, 9, 0));
    CHECK(refusal(document("2"), bin(2, 1)).substr(0, 40) == "/accessors/0/sparse/indices: value 1 is ");
    CHECK(refusal(document("2"), bin(1, 1)).substr(0, 40) == "/accessors/0/sparse/indices: value 1 is ");
    CHECK(refusal(document("2"), bin(1, 3)).substr(0, 40) == "/accessors/0/sparse/indices: value 1 is ");
    CHECK(refusal(document("4"), bin(1, 2)).substr(0, 31) == "/accessors/0/sparse/count: is 4");
    CHECK(refusal(document("3"), bin(1, 2)).find("reach beyond the 2 bytes of /bufferViews/2") != std::string::npos);
    CHECK(refusal(document("2"), bin(1, 2, std::numeric_limits<float>::infinity()))
              .find("component 0 of element 1 is inf") != std::string::npos);
}

TEST_CASE("JSON that nests without end, or is none, is refused", "[cpu][gltf]") {
    const std::string deep(1'000'000, '[');
    CHECK(refusal(deep) == "byte 64: the JSON nests deeper than the limit of 64");
    CHECK(refusal(R"({"asset":{"version":"2.0"},"extras":)" + deep + std::string(deep.size(), ']') + "}")
              .find("nests deeper") != std::string::npos);
    CHECK(refusal("{\"asset\":").substr(0, 17) == "is not valid JSON");
    CHECK(refusal("{\"asset\":\"\xFF\"}").substr(0, 17) == "is not valid JSON");
    CHECK(refusal("[]") == "/: must be an object, is array");
    CHECK(refusal("{}") == "/: lacks the required member \"asset\"");
    CHECK(refusal("\xEF\xBB\xBF{}").find("byte order mark") != std::string::npos);
    // Brackets inside strings are no nesting.
    CHECK(refusal(with(triangle_json, R"("version":"2.0")",
                       R"("version":"2.0","generator":"\")" + std::string(200, '[') + "\"")) == "");
}

TEST_CASE("nodes may be deep, but not without end", "[cpu][gltf]") {
    const auto chain = [](int length) {
        std::string nodes = R"([{"mesh":0})";
        for (int i = 0; i < length; ++i) nodes += R"(,{"children":[)" + std::to_string(i) + "]}";
        return with(with(triangle_json, R"([{"mesh":0})", nodes), R"("nodes":[0])",
                    R"("nodes":[)" + std::to_string(length) + "]");
    };
    CHECK(refusal(chain(1024)) == "");
    CHECK(refusal(chain(1025)) == "/nodes/0: is 1025 nodes below its root, the limit is 1024");
}

TEST_CASE("every prefix of a .glb is refused, and every single-byte change is survived", "[cpu][gltf]") {
    const TemporaryFolder folder;
    const std::string path = folder / "test.glb", whole = make_glb(triangle_json, triangle_bin());
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write_bytes(path, whole.substr(0, size));
        REQUIRE_FALSE(load_gltf(path));
    }
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ (1 << at % 8));
        write_bytes(path, changed);
        const auto scene = load_gltf(path);
        refused += scene ? 0 : 1;
        if (scene) CHECK(scene->meshes.size() <= 1);
    }
    CHECK(refused > whole.size() / 2);
}

TEST_CASE("a small file cannot ask for a large scene", "[cpu][gltf]") {
    const std::string vast = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"componentType":5126,"count":3000000000,"type":"VEC3"}]})";
    CHECK(refusal(vast, "").find("which takes more than the limit of") != std::string::npos);
    // Thousands of primitives that share one accessor.
    std::string bin;
    for (int i = 0; i < 3000; ++i) bin += bytes_of({0.0f, 1.0f, 2.0f});
    std::string primitives = R"({"attributes":{"POSITION":0}})";
    for (int i = 0; i < 5000; ++i) primitives += R"(,{"attributes":{"POSITION":0}})";
    const std::string shared = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[)" + primitives + R"(]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3000,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36000}],"buffers":[{"byteLength":36000}]})";
    CHECK(refusal(shared, bin).find("the meshes so far take") != std::string::npos);
    // Thousands of nodes that show a mesh of thousands of primitives.
    std::string nodes = "{\"mesh\":0}";
    for (int i = 0; i < 5000; ++i) nodes += ",{\"mesh\":0}";
    const std::string crowd =
        with(with(shared, R"("count":3000)", R"("count":3)"), R"("meshes")", R"("nodes":[)" + nodes + R"(],"meshes")");
    CHECK(refusal(crowd, bin).find("meshes and instances so far take") != std::string::npos);
    // Thousands of buffers that are one file, which is read once; as many spellings of its name are not.
    const TemporaryFolder folder;
    write_bytes(folder / "a.bin", std::string(1 << 20, '\0'));
    const auto many = [&](bool same) {
        std::string buffers, name = "a.bin";
        for (int i = 0; i < 3000; ++i) {
            buffers += (i ? "," : "") + std::string(R"({"byteLength":4,"uri":")") + name + "\"}";
            if (!same) name = (i % 100 ? "./" : "") + (i % 100 ? name : std::string("a.bin"));
        }
        write_bytes(folder / "many.gltf", R"({"asset":{"version":"2.0"},"buffers":[)" + buffers + "]}");
        GltfLimits limits;
        limits.max_file_bytes = std::uint64_t{20} << 20u;
        const auto scene = load_gltf(folder / "many.gltf", limits);
        return scene ? std::string() : scene.error().message;
    };
    CHECK(many(true) == "");
    CHECK(many(false).find("the limit is") != std::string::npos);
    // Millions of empty objects.
    std::string empty = "{}";
    for (int i = 0; i < 200'000; ++i) empty += ",{}";
    CHECK(refusal(R"({"asset":{"version":"2.0"},"materials":[)" + empty + "]}", "").find("/materials: tables so far") ==
          0);
    GltfLimits tight;
    tight.max_json_bytes = 100;
    CHECK(refusal(triangle_json, triangle_bin(), tight).find("the limit is 100") != std::string::npos);
}

TEST_CASE("long tables take linear time", "[cpu][gltf]") {
    // Quadratic time would be minutes here.
    std::string nodes = R"({"extras":[]})", scenes = R"({"nodes":[0]})";
    for (int i = 0; i < 30'000; ++i)
        nodes += R"(,{"name":"node","extras":{"a":[1,2,3]}})", scenes += R"(,{"nodes":[1]})";
    CHECK(refusal(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + R"(],"scenes":[)" + scenes + "]}", "") == "");
}

TEST_CASE("files that cannot be read say why", "[cpu][gltf]") {
    const TemporaryFolder folder;
    const auto missing = load_gltf(folder / "none.gltf");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == Errc::io);
    CHECK(missing.error().message == (folder / "none.gltf") + ": there is no such file");
    const auto device = load_gltf("/dev/zero");
    REQUIRE_FALSE(device);
    CHECK(device.error().message == "/dev/zero: is not a regular file");
}
