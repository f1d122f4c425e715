// SPDX-License-Identifier: MIT
/// \file
/// load(write(scene)) is the scene, bit by bit.
#include <pellucid/scene/demo_scene.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include <pellucid/scene/primitives.hpp>
#include <pellucid/scene/tangents.hpp>
#include <glm/geometric.hpp>
#include "scene/gltf_text.hpp"
#include "support/catch.hpp"

using namespace pellucid;
using namespace pellucid::test;

namespace {

void check_same(const TextureRef& a, const TextureRef& b) {
    CHECK(a.texture == b.texture);
    if (!a.used()) return;
    CHECK((a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation));
}

void check_same(const Scene& a, const Scene& b) {
    REQUIRE(a.meshes.size() == b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        const Mesh &x = a.meshes[i], &y = b.meshes[i];
        CHECK((x.positions == y.positions && x.normals == y.normals && x.tangents == y.tangents));
        CHECK((x.uv0 == y.uv0 && x.uv1 == y.uv1 && x.colors == y.colors && x.indices == y.indices));
        CHECK((x.material == y.material && x.lower == y.lower && x.upper == y.upper && x.name == y.name));
    }
    REQUIRE(a.instances.size() == b.instances.size());
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
        CHECK(a.instances[i].mesh == b.instances[i].mesh);
        CHECK(a.instances[i].world_from_object == b.instances[i].world_from_object);
    }
    REQUIRE(a.materials.size() == b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        const Material &x = a.materials[i], &y = b.materials[i];
        CHECK((x.base_color == y.base_color && x.metallic == y.metallic && x.roughness == y.roughness));
        CHECK((x.emissive == y.emissive && x.normal_scale == y.normal_scale && x.alpha_cutoff == y.alpha_cutoff));
        CHECK((x.occlusion_strength == y.occlusion_strength && x.alpha_mode == y.alpha_mode));
        CHECK((x.double_sided == y.double_sided && x.unlit == y.unlit && x.name == y.name));
        check_same(x.base_color_texture, y.base_color_texture);
        check_same(x.metallic_roughness_texture, y.metallic_roughness_texture);
        check_same(x.normal_texture, y.normal_texture);
        check_same(x.occlusion_texture, y.occlusion_texture);
        check_same(x.emissive_texture, y.emissive_texture);
    }
    REQUIRE(a.textures.size() == b.textures.size());
    for (std::size_t i = 0; i < a.textures.size(); ++i)
        CHECK((a.textures[i].image == b.textures[i].image && a.textures[i].sampler == b.textures[i].sampler));
    REQUIRE(a.images.size() == b.images.size());
    for (std::size_t i = 0; i < a.images.size(); ++i)
        CHECK((a.images[i].pixels.data == b.images[i].pixels.data && a.images[i].name == b.images[i].name));
    REQUIRE(a.lights.size() == b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        const Light &x = a.lights[i], &y = b.lights[i];
        CHECK((x.kind == y.kind && x.color == y.color && x.intensity == y.intensity && x.range == y.range));
        CHECK((x.position == y.position && x.name == y.name));
        if (x.kind == LightKind::spot) CHECK((x.inner_cone == y.inner_cone && x.outer_cone == y.outer_cone));
        if (x.kind != LightKind::point) CHECK(x.direction == y.direction);
    }
    REQUIRE(a.cameras.size() == b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        const Camera &x = a.cameras[i], &y = b.cameras[i];
        CHECK((x.projection == y.projection && x.near == y.near && x.name == y.name));
        CHECK(x.world_from_view == y.world_from_view);
        if (x.projection == Projection::perspective)
            CHECK(x.vertical_fov == y.vertical_fov);
        else
            CHECK((x.half_width == y.half_width && x.half_height == y.half_height && x.far == y.far));
    }
}

Scene round_trip(const Scene& scene) {
    const TemporaryFolder folder;
    const auto written = write_gltf(folder / "scene.glb", scene);
    INFO((written ? std::string() : written.error().message));
    REQUIRE(written);
    auto back = load_gltf(folder / "scene.glb");
    INFO((back ? std::string() : back.error().message));
    REQUIRE(back);
    CHECK(back->warnings.empty());
    return std::move(*back);
}

}  // namespace

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
