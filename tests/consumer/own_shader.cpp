// SPDX-License-Identifier: MIT
// The embedded forms of a consumer's own shader are there and begin as they must.
#include <pellucid/core/version.hpp>
#include <pellucid/shaders/tint.hpp>
#include <cstdio>

int main() {
    const pellucid::rhi::Shader& shader = pellucid::shaders::tint_comp;
    std::printf("pellucid %s, %s: %zu words for Vulkan, %zu for OpenGL\n", PELLUCID_VERSION_STRING, shader.name,
                shader.spirv.size(), shader.gl_spirv.size());
    const bool good = shader.spirv.size() > 5 && shader.spirv[0] == 0x07230203u && shader.gl_spirv.size() > 5 &&
                      shader.gl_text.starts_with("#version 450");
    return good ? 0 : 1;
}
