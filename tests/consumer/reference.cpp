// SPDX-License-Identifier: MIT
// A consumer of the reference renderer alone: a grey sheet of glass over white.
#include <pellucid/reference/renderer.hpp>
#include <cstdio>

int main() {
    pellucid::Scene scene;
    scene.meshes.push_back({.positions = {{-9, -9, -3}, {9, -9, -3}, {0, 9, -3}},
                            .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                            .indices = {0, 1, 2}});
    scene.materials.push_back(
        {.base_color = {0.5f, 0.5f, 0.5f, 0.5f}, .alpha_mode = pellucid::AlphaMode::blend, .unlit = true});
    scene.instances.push_back({});
    const auto picture = pellucid::reference::render(scene, {}, {.size = {4, 4}, .background = {1, 1, 1}});
    if (!picture) return std::fprintf(stderr, "%s\n", picture.error().message.c_str()), 1;
    const float radiance = picture->radiance.texel(1, 2)[0];
    std::printf("radiance %g, %u layer\n", static_cast<double>(radiance), *picture->layers.texel(1, 2));
    return radiance == 0.75f && *picture->layers.texel(1, 2) == 1 ? 0 : 1;
}
