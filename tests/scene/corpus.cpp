// SPDX-License-Identifier: MIT
/// \file
/// The corpus of malformed files with the verdict of the format's official validator: nothing crashes, what matters is
/// refused, what is valid loads.
#include <pellucid/scene/gltf.hpp>
#include <fstream>
#include <sstream>
#include "support/assets.hpp"
#include "support/catch.hpp"

using namespace pellucid;

namespace {

/// Valid files that are refused all the same, and why.
struct Exception {
    const char* file;  ///< end of the path
    const char* says;  ///< part of our refusal
};
constexpr Exception refused_though_valid[] = {
    // A warning for the validator; read by us it would have no meaning.
    {"accessor/unknown_type.gltf", "none of SCALAR to MAT4"},
    {"light/unknown_type.gltf", "none of directional, point, spot"},
    {"camera/perspective_yfov.gltf", "must be below pi"},
    // Asks for a later version of the format.
    {"asset/min_version_valid.gltf", "this loader reads 2.0"},
    // Nothing here reads from a network.
    {"buffer/non_relative_uri.gltf", "no relative path"},
    // Primitives whose buffer is a placeholder without data.
    {"root/named_objects.gltf", "neither a uri nor a BIN chunk"},
    {"root/unused_objects.gltf", "neither a uri nor a BIN chunk"}};

/// Errors of the validator that a file may have and load: none of them touches memory, the GPU or what is shown.
/// `where`: part of the path, for codes that are harmless in some places only.
struct Untidy {
    const char* code;
    const char* where;
};
constexpr Untidy untidy[] = {
    // Nothing is animated and nothing is skinned or morphed: the tables are checked for references only.
    {"ACCESSOR_ANIMATION_INPUT_NEGATIVE", ""},
    {"ACCESSOR_ANIMATION_INPUT_NON_INCREASING", ""},
    {"ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION", ""},
    {"ANIMATION_CHANNEL_TARGET_NODE_MATRIX", ""},
    {"ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", ""},
    {"ANIMATION_DUPLICATE_TARGETS", ""},
    {"ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", ""},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", ""},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", ""},
    {"ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", ""},
    {"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", ""},
    {"ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", ""},
    {"KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE", ""},
    {"KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH", ""},
    {"PATTERN_MISMATCH", "KHR_animation_pointer"},
    {"UNDEFINED_PROPERTY", "KHR_animation_pointer"},
    {"ACCESSOR_INVALID_IBM", ""},
    {"INVALID_IBM_ACCESSOR_COUNT", ""},
    {"SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", ""},
    {"SKIN_IBM_INVALID_FORMAT", ""},
    {"SKIN_NO_COMMON_ROOT", ""},
    {"SKIN_SKELETON_INVALID", ""},
    {"NODE_SKIN_NO_SCENE", ""},
    {"NODE_SKIN_WITH_NON_SKINNED_MESH", ""},
    {"ACCESSOR_JOINTS_INDEX_DUPLICATE", ""},
    {"ACCESSOR_JOINTS_INDEX_OOB", ""},
    {"ACCESSOR_WEIGHTS_NEGATIVE", ""},
    {"ACCESSOR_WEIGHTS_NON_NORMALIZED", ""},
    {"MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", ""},
    {"MESH_INVALID_WEIGHTS_COUNT", ""},
    {"MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT", ""},
    {"MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", ""},
    {"MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", ""},
    {"NODE_WEIGHTS_INVALID", ""},
    {"UNSATISFIED_DEPENDENCY", "node/weights_with_no_mesh"},
    // Bounds are computed from the positions: the file's own are not used.
    {"ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", ""},
    {"ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", ""},
    {"ACCESSOR_MAX_MISMATCH", ""},
    {"ACCESSOR_MIN_MISMATCH", ""},
    {"MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", ""},
    // Put right on loading: normals are normalised, signs taken from w < 0, colours clamped.
    {"ACCESSOR_VECTOR3_NON_UNIT", ""},
    {"ACCESSOR_INVALID_SIGN", ""},
    {"ACCESSOR_NON_CLAMPED", ""},
    // Attributes that nobody reads; missing texture coordinates are (0, 0), with a warning.
    {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", ""},
    {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", ""},
    {"MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", ""},
    {"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", ""},
    {"MESH_PRIMITIVE_NO_TANGENT_SPACE", ""},
    // Hints for uploading buffers: we lay out our own.
    {"BUFFER_VIEW_TARGET_OVERRIDE", ""},
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE", "invalid_stride_wrong_target"},
    {"IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", ""},
    // Data that no mesh uses is not looked at.
    {"ACCESSOR_INVALID_FLOAT", "accessor_data/invalid_elements_float"},
    // A chunk or a buffer that nothing uses.
    {"GLB_UNEXPECTED_BIN_CHUNK", ""},
    {"BUFFER_MISSING_GLB_DATA", ""},
    // Pictures that no material shows are not opened; the first bytes of one tell its type.
    {"IMAGE_DATA_INVALID", "data/image/"},
    {"IMAGE_UNEXPECTED_EOS", "data/image/"},
    {"IO_ERROR", "data/image/"},
    {"IMAGE_MIME_TYPE_INVALID", ""},
    {"INVALID_URI", "data/image/"},
    // The data is there and decodes, whatever the media type says.
    {"BUFFER_DATA_URI_MIME_TYPE_INVALID", ""},
    {"INVALID_URI", "buffer/invalid_uri_data.gltf"},
    // Empty arrays hold nothing; doubled names of extensions are known already.
    {"EMPTY_ENTITY", ""},
    {"DUPLICATE_ELEMENTS", ""},
    // Extensions that were not announced, stand in a wrong place, or that nothing here reads.
    {"UNDECLARED_EXTENSION", ""},
    {"UNEXPECTED_EXTENSION_OBJECT", ""},
    {"NON_REQUIRED_EXTENSION", ""},
    {"TYPE_MISMATCH", "root/extensions_non_objects"},
    {"TYPE_MISMATCH", "KHR_materials_variants"},
    {"KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", ""},
    {"UNDEFINED_PROPERTY", "KHR_materials_variants"},
    {"UNRESOLVED_REFERENCE", "KHR_materials_variants"},
    {"UNSATISFIED_DEPENDENCY", "KHR_materials_variants"},
    {"VALUE_NOT_IN_RANGE", "KHR_materials_anisotropy"},
    {"VALUE_NOT_IN_RANGE", "KHR_materials_dispersion"},
    {"VALUE_NOT_IN_RANGE", "KHR_materials_ior"},
    {"VALUE_NOT_IN_RANGE", "KHR_materials_specular"},
    {"VALUE_NOT_IN_RANGE", "KHR_materials_volume"}};

bool is_untidy(const std::string& code, const std::string& file) {
    for (const Untidy& known : untidy)
        if (code == known.code && file.find(known.where) != std::string::npos) return true;
    return false;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

}  // namespace

TEST_CASE("the corpus of malformed files", "[cpu][gltf]") {
    const auto assets = test::assets();
    if (!assets) return;
    int valid_loaded = 0, valid_refused = 0, wrong_loaded = 0, wrong_refused = 0;
    for (const char* folder : {"gltf-validator", "tinygltf"}) {
        const auto base = *assets / "malformed" / folder;
        std::ifstream table(base / "EXPECTED.tsv");
        REQUIRE(table);
        std::string line;
        std::getline(table, line);
        while (std::getline(table, line)) {
            const std::vector<std::string> row = split(line, '\t');
            REQUIRE(row.size() >= 3);
            const std::string& file = row[0];
            const auto scene = load_gltf((base / file).string());
            INFO(file << ": " << (scene ? "loads" : scene.error().message));
            if (!scene) {
                CHECK((scene.error().code == Errc::parse || scene.error().code == Errc::io));
                CHECK(scene.error().message.substr(0, (base / file).string().size()) == (base / file).string());
            }
            if (row[1] == "0") {
                ++(scene ? valid_loaded : valid_refused);
                if (scene) continue;
                bool known = false;
                for (const Exception& exception : refused_though_valid)
                    known = known || (file.ends_with(exception.file) &&
                                      scene.error().message.find(exception.says) != std::string::npos);
                CHECK(known);
                continue;
            }
            ++(scene ? wrong_loaded : wrong_refused);
            REQUIRE(row.size() == 4);
            for (const std::string& code : split(row[3], ',')) {
                INFO(code);
                CHECK((!scene || is_untidy(code, file)));
            }
        }
    }
    int found_by_fuzzing = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*assets / "malformed" / "fuzz-found")) {
        CHECK_FALSE(load_gltf(entry.path().string()));
        ++found_by_fuzzing;
    }
    std::printf(
        "corpus: %d valid files load, %d are refused; %d invalid ones are refused, %d untidy ones load; "
        "%d found by fuzzing are refused\n",
        valid_loaded, valid_refused, wrong_refused, wrong_loaded, found_by_fuzzing);
    CHECK(valid_loaded + valid_refused > 100);
    CHECK(wrong_refused > 100);
}
