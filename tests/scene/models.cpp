// SPDX-License-Identifier: MIT
/// \file
/// Real models: each loads, keeps the rules of `Scene`, and has what its authors say it has.
#include <pellucid/scene/gltf.hpp>
#include <glm/geometric.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include "support/assets.hpp"
#include "support/catch.hpp"

using namespace pellucid;

namespace {

void check_rules(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t count = mesh.positions.size();
        REQUIRE(count > 0);
        REQUIRE(mesh.normals.size() == count);
        for (const std::size_t size : {mesh.tangents.size(), mesh.uv0.size(), mesh.uv1.size(), mesh.colors.size()})
            REQUIRE((size == 0 || size == count));
        REQUIRE(mesh.indices.size() % 3 == 0);
        REQUIRE(*std::max_element(mesh.indices.begin(), mesh.indices.end()) < count);
        REQUIRE(mesh.material < scene.materials.size());
        REQUIRE(scene.materials[mesh.material].normal_texture.used() == !mesh.tangents.empty());
        for (const glm::vec3& n : mesh.normals) REQUIRE(std::abs(glm::length(n) - 1) < 1e-5f);
        for (const glm::vec4& t : mesh.tangents) REQUIRE(std::abs(glm::length(glm::vec3(t)) - 1) < 1e-5f);
    }
    for (const Instance& instance : scene.instances) REQUIRE(instance.mesh < scene.meshes.size());
    for (const Material& m : scene.materials)
        for (const TextureRef* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                      &m.occlusion_texture, &m.emissive_texture})
            REQUIRE((!ref->used() || (ref->texture < scene.textures.size() && ref->uv_set < 2)));
    for (const SceneTexture& texture : scene.textures) REQUIRE(texture.image < scene.images.size());
    for (const SceneImage& image : scene.images) REQUIRE((image.pixels.channels == 4 && !image.pixels.empty()));
}

std::size_t triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.indices.size() / 3;
    return count;
}

}  // namespace

TEST_CASE("all models load", "[cpu][gltf]") {
    const auto assets = test::assets();
    if (!assets) return;
    std::map<std::string, Scene> scenes;
    for (const auto& folder : std::filesystem::directory_iterator(*assets / "models"))
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".gltf" && extension != ".glb") continue;
            auto scene = load_gltf(entry.path().string());
            INFO((scene ? entry.path().string() : scene.error().message));
            REQUIRE(scene);
            check_rules(*scene);
            const std::string name = entry.path().stem().string();
            std::printf(
                "%-28s %3zu meshes %7zu triangles %3zu instances %2zu materials %2zu textures %zu lights "
                "%zu cameras %zu warnings\n",
                name.c_str(), scene->meshes.size(), triangles(*scene), scene->instances.size(), scene->materials.size(),
                scene->textures.size(), scene->lights.size(), scene->cameras.size(), scene->warnings.size());
            for (const std::string& warning : scene->warnings) std::printf("    %s\n", warning.c_str());
            for (SceneImage& image : scene->images) image.pixels = Image8(1, 1, 4);  // counted, not kept
            scenes.emplace(name, std::move(*scene));
        }
    CHECK(scenes.size() >= 26);
    const auto is = [&](const char* name) -> const Scene& {
        REQUIRE(scenes.count(name) == 1);
        return scenes.at(name);
    };
    CHECK(triangles(is("Box")) == 12);
    CHECK(is("Box").meshes[0].positions.size() == 24);
    CHECK(is("BoxVertexColors").meshes[0].colors.size() == 24);
    CHECK(is("Cameras").cameras.size() == 2);
    CHECK(is("Cameras").cameras[1].projection == Projection::orthographic);
    CHECK(is("LightsPunctualLamp").lights.size() == 5);
    CHECK(triangles(is("MetalRoughSpheresNoTextures")) == 1040409);
    CHECK(is("many-cubes").instances.size() == 501);
    CHECK(is("Avocado").images.size() == 3);
    CHECK(triangles(is("Avocado")) == 682);
    const Scene& sparse = is("SimpleSparseAccessor");
    CHECK(sparse.meshes[0].upper.y == 4);  // a vertex moved by the sparse values
    const Scene& blend = is("AlphaBlendModeTest");
    std::map<AlphaMode, int> modes;
    for (const Material& m : blend.materials) ++modes[m.alpha_mode];
    CHECK((modes[AlphaMode::opaque] >= 1 && modes[AlphaMode::mask] >= 2 && modes[AlphaMode::blend] >= 1));
    for (const Material& m : is("UnlitTest").materials) CHECK(m.unlit);
    float brightest = 0;
    for (const Material& m : is("EmissiveStrengthTest").materials) brightest = std::max(brightest, m.emissive.z);
    CHECK(brightest == 14.4f);  // 0.9 times a strength of 16
    int mirrored = 0;
    for (const Instance& instance : is("NegativeScaleTest").instances)
        mirrored += glm::determinant(glm::dmat3(instance.world_from_object)) < 0 ? 1 : 0;
    CHECK(mirrored > 0);
    bool transformed = false;
    for (const Material& m : is("TextureTransformTest").materials)
        transformed = transformed || m.base_color_texture.rotation != 0;
    CHECK(transformed);
    CHECK(is("TransmissionTest").cameras.size() == 1);
    CHECK(is("TextureSettingsTest").textures.size() == 9);
    CHECK(is("TwoSidedPlane").materials[0].double_sided);
}

TEST_CASE("the scenes with known answers load without a warning", "[cpu][gltf]") {
    const auto folder = test::scenes();
    if (!folder) return;
    for (const char* name : {"L1_lit", "S1_random_quads", "S2_intersecting_planes", "S3_linked_chain"}) {
        const auto scene = load_gltf((*folder / (std::string(name) + ".gltf")).string());
        INFO((scene ? std::string(name) : scene.error().message));
        REQUIRE(scene);
        check_rules(*scene);
        CHECK(scene->warnings.empty());
        CHECK(scene->cameras.size() == 1);
        const auto reference = read_pfm((*folder / (std::string(name) + ".reference.pfm")).string());
        REQUIRE(reference);
        CHECK((reference->width == 256 && reference->height == 256 && reference->channels == 3));
        const auto stable = read_pgm((*folder / (std::string(name) + ".stable.pgm")).string());
        REQUIRE(stable);
        CHECK((stable->width == 256 && stable->height == 256));
    }
}
