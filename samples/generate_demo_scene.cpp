// SPDX-License-Identifier: MIT
// Writes the project's own demo scene as a glTF file.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: generate_demo_scene FILE.glb\n"), 2;
    const pellucid::Result<void> written = pellucid::write_gltf(argv[1], pellucid::make_demo_scene());
    if (!written) return std::fprintf(stderr, "generate_demo_scene: %s\n", written.error().message.c_str()), 1;
    std::printf("%s\n", argv[1]);
    return 0;
}
