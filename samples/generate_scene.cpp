// SPDX-License-Identifier: MIT
/// \file
/// generate_scene NAME FILE.glb: writes one of the project's own scenes as a glTF file; --list names them.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include <pellucid/scene/light_field.hpp>
#include <pellucid/scene/sample_scenes.hpp>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

using namespace pellucid;

struct Sample {
    const char* name;
    const char* what;
    Scene (*make)();
};
constexpr Sample samples[] = {
    {"demo", "25 spheres over metallic and roughness, two translucent cubes, eight lights", make_demo_scene},
    {"peeling", "translucent teapot, pane and sphere that cut each other, one sun; best on black", make_peeling_scene},
    {"linked_chain", "a necklace of eight translucent tori, each through its neighbours",
     [] { return make_linked_chain(); }},
    {"intersecting_planes", "three translucent panes that cross inside an opaque cube",
     [] { return make_intersecting_planes(); }},
    {"random_quads", "64 translucent rectangles in all directions over an opaque floor",
     [] { return make_random_quads(); }},
    {"cyclic_triangles", "three translucent triangles, each in front of the next all the way round",
     make_cyclic_triangles},
    {"lit_glass", "translucent sphere and panes, metal sphere and floor under sun, point light and spot",
     [] { return make_lit_glass(); }},
    {"teapot_grid", "110 translucent teapots of 9,120 triangles each over an opaque floor",
     [] { return make_teapot_grid(); }},
    {"light_field", "1000 small lights, points and spots, over a floor with pillars, and panes between them",
     [] { return make_light_field(); }},
    {"sheets", "an opaque sheet behind three translucent ones across the whole view: one colour",
     [] {
         return make_sheets({{.slot = 32, .color = {0.5f, 0.5f, 0.5f, 1}, .opaque = true},
                             {.slot = 128, .color = {1, 0, 0, 0.5f}},
                             {.slot = 192, .color = {0, 0, 1, 0.25f}},
                             {.slot = 64, .color = {0, 1, 0, 0.5f}}});
     }},
};

int usage(const char* what) {
    std::fprintf(stderr, "generate_scene: %s (usage: generate_scene NAME FILE.glb, or --list for the names)\n", what);
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
        for (const Sample& sample : samples) std::printf("%-20s %s\n", sample.name, sample.what);
        return 0;
    }
    if (argc != 3 || argv[2][0] == '-') return usage("it takes the name of a scene and of the file to write");
    const Sample* sample = nullptr;
    for (const Sample& candidate : samples)
        if (std::strcmp(candidate.name, argv[1]) == 0) sample = &candidate;
    if (!sample) return usage((std::string("there is no scene called '") + argv[1] + "'").c_str());

    const Scene scene = sample->make();
    if (const auto written = write_gltf(argv[2], scene); !written) {
        std::fprintf(stderr, "generate_scene: %s\n", written.error().message.c_str());
        return 3;
    }
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances) triangles += scene.meshes[instance.mesh].indices.size() / 3;
    std::printf("%s: %zu instances, %zu triangles, %zu lights\n", argv[2], scene.instances.size(), triangles,
                scene.lights.size());
    return 0;
}
