// SPDX-License-Identifier: MIT
// Reading specialisation constants out of SPIR-V.
#include "../../../backends/opengl/spirv.hpp"
#include <pellucid/shaders/test.hpp>
#include "support/catch.hpp"

namespace pellucid::inline v0_1::opengl {

using Constants = std::vector<rhi::SpecConstant>;

TEST_CASE("a module's constants are found with their defaults", "[cpu]") {
    CHECK(declared_constants(shaders::test_spec_frag.gl_spirv) ==
          Constants{{.id = 0, .value = 1}, {.id = 7, .value = 2}});
    CHECK(declared_constants(shaders::test_color_frag.gl_spirv).empty());
}

TEST_CASE("a module cut anywhere gives fewer constants and reads nothing behind its end", "[cpu]") {
    const auto whole = shaders::test_spec_frag.gl_spirv;
    for (std::size_t n = 0; n <= whole.size(); ++n) {
        const std::vector<std::uint32_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n));
        CHECK(declared_constants(cut).size() <= 2);
    }
}

TEST_CASE("given values replace defaults, and unknown ids are left out", "[cpu]") {
    const rhi::SpecConstant given[] = {{.id = 7, .value = 70}, {.id = 9, .value = 90}};
    CHECK(merged_constants({{.id = 0, .value = 1}, {.id = 7, .value = 2}}, given) ==
          Constants{{.id = 0, .value = 1}, {.id = 7, .value = 70}});
}

}  // namespace pellucid::inline v0_1::opengl
