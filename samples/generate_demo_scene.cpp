// SPDX-License-Identifier: MIT
/// \file
/// generate_demo_scene FILE.glb: writes the project's demo scene as a glTF file.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2 || argv[1][0] == '-') {
        std::fprintf(stderr, "usage: generate_demo_scene FILE.glb\n");
        return 2;
    }
    const pellucid::Scene scene = pellucid::make_demo_scene();
    if (const auto written = pellucid::write_gltf(argv[1], scene); !written) {
        std::fprintf(stderr, "generate_demo_scene: %s\n", written.error().message.c_str());
        return 3;
    }
    std::size_t triangles = 0;
    for (const pellucid::Instance& instance : scene.instances)
        triangles += scene.meshes[instance.mesh].indices.size() / 3;
    std::printf("%s: %zu instances, %zu triangles, %zu lights\n", argv[1], scene.instances.size(), triangles,
                scene.lights.size());
    return 0;
}
