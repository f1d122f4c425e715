// SPDX-License-Identifier: MIT
/// \file
/// load(write(scene)) is the scene, bit by bit.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include "scene/same_scene.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

TEST_CASE("the demo scene comes back as it was written", "[cpu][gltf]") {
    const Scene scene = make_demo_scene();
    CHECK(scene.lights.size() == 8);
    CHECK(scene.cameras.size() == 1);
    int spheres = 0, translucent = 0;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[mesh.material];
        spheres += mesh.name.starts_with("sphere") ? 1 : 0;
        translucent += material.alpha_mode == AlphaMode::blend ? 1 : 0;
        for (const glm::vec3& n : mesh.normals) REQUIRE(std::abs(glm::length(n) - 1) < 1e-6f);
    }
    CHECK(spheres == 25);
    CHECK(translucent == 2);
    check_same(scene, round_trip(scene));
}

TEST_CASE("a scene that uses everything comes back as it was written", "[cpu][gltf]") {
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        Image8 pixels(3, 2, 4);
        for (std::size_t k = 0; k < pixels.data.size(); ++k)
            pixels.data[k] = static_cast<std::uint8_t>(k * 7 + 100 * i);
        scene.images.push_back({pixels, "image " + std::to_string(i)});
    }
    for (const bool mipmapped : {false, true})
        for (const TextureFilter filter : {TextureFilter::nearest, TextureFilter::linear})
            scene.textures.push_back({.image = mipmapped ? 1u : 0u,
                                      .sampler = {.min = filter,
                                                  .mag = mipmapped ? TextureFilter::nearest : TextureFilter::linear,
                                                  .mip = mipmapped ? TextureFilter::linear : TextureFilter::nearest,
                                                  .mipmapped = mipmapped,
                                                  .wrap_u = TextureWrap::mirror,
                                                  .wrap_v = TextureWrap::clamp}});
    scene.materials = {
        {.base_color = {0.1f, 0.2f, 0.3f, 0.7f},
         .metallic = 0.3f,
         .roughness = 0.6f,
         .emissive = {5, 0.1f, 3.3f},
         .normal_scale = 0.5f,
         .occlusion_strength = 0.3f,
         .alpha_mode = AlphaMode::blend,
         .base_color_texture = {.texture = 0, .uv_set = 1, .offset = {0.5f, 0.1f}, .scale = {3, -1}, .rotation = 0.7f},
         .metallic_roughness_texture = {.texture = 1},
         .normal_texture = {.texture = 2},
         .occlusion_texture = {.texture = 3},
         .emissive_texture = {.texture = 2, .uv_set = 1},
         .name = "all \"quoted\" \xC3\xBC"},
        {.emissive = {0.5f, 0.1f, 0},
         .alpha_cutoff = 0.2f,
         .alpha_mode = AlphaMode::mask,
         .double_sided = true,
         .unlit = true}};
    Mesh sphere = make_uv_sphere(1, 7, 9);
    sphere.uv1 = sphere.uv0;
    sphere.colors.assign(sphere.positions.size(), {0.1f, 0.2f, 0.3f, 0.4f});
    make_tangents(sphere);
    scene.meshes = {sphere, make_icosphere(0.5f, 2), make_plane(2, 3, 4)};
    scene.meshes[1].material = scene.meshes[2].material = 1;
    glm::dmat4 sheared(1.0);
    sheared[1][0] = 0.1;
    sheared[0][0] = -1.0 / 3.0;
    sheared[3][2] = 1e7 + 0.1;
    scene.instances = {{2, glm::dmat4(1.0)}, {0, sheared}, {1, sheared * sheared}, {0, glm::dmat4(1.0)}};
    scene.lights = {{.kind = LightKind::directional,
                     .intensity = 3,
                     .direction = glm::normalize(glm::dvec3(1, -2, 0.5)),
                     .name = "sun"},
                    {.kind = LightKind::spot,
                     .color = {1, 0.5f, 0.1f},
                     .intensity = 40,
                     .range = 12.5f,
                     .inner_cone = 0.2,
                     .outer_cone = 0.4,
                     .position = {1, 2, 3},
                     .direction = {0, -1, 0},
                     .name = "spot"},
                    {.position = {0.1, 0.2, 0.3}}};
    Camera camera{.vertical_fov = 0.7, .near = 0.01, .name = "eye"};
    camera.world_from_view = look_at({3, 2, 1}, {0, 0.5, 0});
    Camera flat{.projection = Projection::orthographic, .half_width = 3, .half_height = 2, .near = 0.5, .far = 100};
    scene.cameras = {camera, flat};
    check_same(scene, round_trip(scene));
}

TEST_CASE("scenes that break their own rules are not written", "[cpu][gltf]") {
    const TemporaryFolder folder;
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {make_cube(1)};
    scene.instances = {{1, glm::dmat4(1.0)}};
    const auto message = [&] {
        const auto written = write_gltf(folder / "a.glb", scene);
        REQUIRE_FALSE(written);
        CHECK(written.error().code == Errc::invalid_argument);
        CHECK_FALSE(std::filesystem::exists(folder / "a.glb"));
        return written.error().message;
    };
    CHECK(message().find("an instance has mesh 1, the scene has 1") != std::string::npos);
    scene.instances.clear();
    scene.meshes[0].indices[3] = 24;
    CHECK(message().find("has an index beyond its 24 positions") != std::string::npos);
    scene.meshes[0].indices.clear();
    CHECK(message().find("which make no triangles") != std::string::npos);
    scene.meshes[0] = make_cube(1);
    scene.meshes[0].material = 1;
    CHECK(message().find("has material 1, the scene has 1") != std::string::npos);
}

TEST_CASE("a premultiplied material is refused with a sentence: glTF cannot say it", "[cpu][gltf]") {
    const TemporaryFolder folder;
    Scene scene;
    scene.materials.resize(3);
    scene.materials[2].alpha_mode = AlphaMode::blend;
    scene.materials[2].name = "flame";
    scene.meshes = {make_cube(1)};
    scene.instances = {{0, glm::dmat4(1.0)}};
    for (const char* name : {"a.glb", "a.gltf"}) {
        scene.materials[2].premultiplied = true;
        const auto written = write_gltf(folder / name, scene);
        REQUIRE_FALSE(written);
        CHECK(written.error().code == Errc::invalid_argument);
        const std::string& message = written.error().message;
        INFO(message);
        CHECK(message.find(folder / name) != std::string::npos);
        CHECK(message.find("material 2 (\"flame\") is premultiplied") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder / name));
        scene.materials[2].premultiplied = false;
        CHECK(write_gltf(folder / name, scene));
    }
}
