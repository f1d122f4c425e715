// SPDX-License-Identifier: MIT
// The structs that C++ and GLSL share: what the compiler says of each member against what the built shaders say
// (SPIR-V's own OpMemberName, OpMemberDecorate Offset and OpDecorate ArrayStride), for Vulkan and for OpenGL.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>
#include "pellucid_gpu_headers.inc"
#include "pellucid_shader_headers.inc"
#include "support/catch.hpp"

using namespace pellucid;

namespace {

/// A struct as one side lays it out.
struct Layout {
    std::map<std::string, std::size_t> offsets;
    std::size_t size = 0;
};

/// What the C++ compiler says.
const std::map<std::string, Layout>& cpp_layouts() {
    static const std::map<std::string, Layout> all = [] {
        std::map<std::string, Layout> out;
#define STRUCT(type) out[#type].size = sizeof(gpu::type);
#define FIELD(type, member) out[#type].offsets[#member] = offsetof(gpu::type, member);
#include "pellucid_gpu_fields.inc"
#undef STRUCT
#undef FIELD
        return out;
    }();
    return all;
}

/// The named structs of one SPIR-V module that have offsets; `size` is the stride of arrays of them, 0 where there are
/// none.  Instruction formats: SPIR-V specification, sections 2.3 and 3.32.
std::vector<std::pair<std::string, Layout>> spirv_layouts(std::span<const std::uint32_t> words) {
    enum : std::uint32_t {
        op_name = 5,
        op_member_name = 6,
        op_type_array = 28,
        op_type_runtime_array = 29,
        op_decorate = 71,
        op_member_decorate = 72,
        array_stride = 6,
        offset = 35
    };
    using Id = std::uint32_t;
    std::map<Id, std::string> names;
    std::map<Id, std::map<std::uint32_t, std::string>> members;
    std::map<Id, std::map<std::uint32_t, std::size_t>> offsets;
    std::map<Id, std::size_t> strides;
    std::map<Id, Id> elements;  // array type -> element type
    auto text = [](const std::uint32_t* at) { return std::string(reinterpret_cast<const char*>(at)); };
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16u) {
        const std::uint32_t* w = &words[i];
        REQUIRE(w[0] >> 16u != 0);
        switch (w[0] & 0xFFFFu) {
            case op_name:
                names[w[1]] = text(w + 2);
                break;
            case op_member_name:
                members[w[1]][w[2]] = text(w + 3);
                break;
            case op_type_array:
            case op_type_runtime_array:
                elements[w[1]] = w[2];
                break;
            case op_decorate:
                if (w[2] == array_stride) strides[w[1]] = w[3];
                break;
            case op_member_decorate:
                if (w[3] == offset) offsets[w[1]][w[2]] = w[4];
                break;
            default:
                break;
        }
    }
    std::vector<std::pair<std::string, Layout>> out;
    for (const auto& [id, places] : offsets) {
        Layout layout;
        for (const auto& [index, at] : places) layout.offsets[members[id][index]] = at;
        for (const auto& [array, element] : elements)
            if (element == id && strides.contains(array)) layout.size = strides[array];
        out.emplace_back(names[id], layout);
    }
    return out;
}

struct Named {
    const char* name;
    const rhi::Shader* shader;
};
const Named all_shaders[] = {
#define SHADER(name) {#name, &shaders::name},
#include "pellucid_shader_names.inc"
#undef SHADER
};

}  // namespace

TEST_CASE("every shader sees the shared structs where C++ has them", "[cpu]") {
    std::map<std::string, int> seen;
    for (const auto& [name, shader] : all_shaders) {
        for (const auto& [api, words] : {std::pair("Vulkan", shader->spirv), std::pair("OpenGL", shader->gl_spirv)}) {
            REQUIRE(words.size() > 5);
            CHECK(words[0] == 0x07230203u);  // SPIR-V's magic number
            for (const auto& [type, layout] : spirv_layouts(words)) {
                const auto cpp = cpp_layouts().find(type);
                if (cpp == cpp_layouts().end()) continue;  // a block of the shader's own
                ++seen[type];
                INFO(api << " shader " << name << ", struct " << type);
                CHECK(layout.offsets == cpp->second.offsets);
                if (layout.size != 0) CHECK(layout.size == cpp->second.size);
            }
        }
    }
    // The comparison is about something: what every frame uses was met.
    for (const char* type : {"DrawRecord", "Vertex", "MaterialRecord", "TextureUse", "LightRecord"}) {
        INFO(type);
        CHECK(seen[type] > 0);
    }
}

TEST_CASE("structs for std140 and std430 alike: sizes are multiples of 16", "[cpu]") {
    CHECK(cpp_layouts().size() >= 5);
    for (const auto& [type, layout] : cpp_layouts()) {
        INFO(type);
        CHECK(layout.size % 16 == 0);
        CHECK_FALSE(layout.offsets.empty());
    }
}
