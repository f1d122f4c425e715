// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// Two scenes are equal, bit by bit; a scene written and read again.
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/gltf_write.hpp>
#include "scene/gltf_text.hpp"
#include "support/catch.hpp"

namespace pellucid::test {

inline void check_same(const TextureRef& a, const TextureRef& b) {
    CHECK(a.texture == b.texture);
    if (!a.used()) return;
    CHECK((a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation));
}

inline void check_same(const Scene& a, const Scene& b) {
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

/// load(write(scene)), which must succeed and warn of nothing.
inline Scene round_trip(const Scene& scene) {
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

}  // namespace pellucid::test
