// SPDX-License-Identifier: MIT
// The whole frame against independent double-precision references, and the two backends against each other, on scenes
// with known answers and on real models.
#include <pellucid/measure/image_error.hpp>
#include <pellucid/renderer/renderer.hpp>
#include <pellucid/scene/framing.hpp>
#include <pellucid/scene/gltf.hpp>
#include <pellucid/scene/image_file.hpp>
#include "support/assets.hpp"
#include "support/devices.hpp"

namespace {

using namespace pellucid;

struct Known {
    const char* name;
    glm::vec3 background;
};
const Known lit{"L1_lit", {0.03921569f, 0.03921569f, 0.05098039f}};
const Known unlit[] = {{"S1_random_quads", {0.10196078f, 0.12156863f, 0.16078431f}},
                       {"S2_intersecting_planes", {0.2f, 0.2f, 0.21960784f}},
                       {"S3_linked_chain", {0.25098039f, 0.25882353f, 0.29803922f}}};

/// What one frame leaves: radiance, display codes and depth (nothing opaque: no depth).
struct Drawn {
    ImageF hdr;
    Image8 display;
    std::vector<std::byte> depth;
};

template <rhi::Backend B>
Drawn draw(typename B::Device& device, const Scene& scene, RenderSettings settings) {
    settings.keep_gbuffer = true;
    auto renderer = test::must(Renderer<B>::create(device, scene, settings));
    const Camera camera = scene.cameras.empty() ? frame_scene(scene, settings.size) : scene.cameras.front();
    test::must(renderer->render(camera));
    Drawn frame{test::must(renderer->read_hdr()), test::must(renderer->read_display()), {}};
    if (renderer->needs().opaque) frame.depth = test::must(renderer->read_gbuffer(Renderer<B>::depth_index)).bytes;
    return frame;
}

RenderSettings known_settings(const Known& known) {
    return {.size = {256, 256}, .background = known.background, .default_light = false};
}

ImageF without_alpha(const ImageF& image) {
    ImageF out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.data.size() / 3; ++i)
        std::copy_n(image.data.data() + 4 * i, 3, out.data.data() + 3 * i);
    return out;
}

measure::ImageError error_of(const Drawn& frame, const std::filesystem::path& folder, const Known& known) {
    const std::string base = (folder / known.name).string();
    const Image8 stable = test::must(read_pgm(base + ".stable.pgm"));
    return test::must(measure::image_error(without_alpha(frame.hdr), test::must(read_pfm(base + ".reference.pfm")),
                                           {.scale = measure::ErrorScale::scaled, .mask = &stable}));
}

/// Models that between them have every kind of material, texture use and transform.
const char* const models[] = {"AlphaBlendModeTest/AlphaBlendModeTest.glb",
                              "Avocado/Avocado.gltf",
                              "BoxVertexColors/BoxVertexColors.glb",
                              "EmissiveStrengthTest/EmissiveStrengthTest.glb",
                              "GlassVaseFlowers/GlassVaseFlowers.glb",
                              "LightsPunctualLamp/LightsPunctualLamp.gltf",
                              "NegativeScaleTest/NegativeScaleTest.glb",
                              "NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
                              "TextureSettingsTest/TextureSettingsTest.glb",
                              "TextureTransformTest/TextureTransformTest.gltf",
                              "UnlitTest/UnlitTest.glb",
                              "VertexColorTest/VertexColorTest.glb",
                              "many-cubes/many-cubes.gltf"};

}  // namespace

TEMPLATE_LIST_TEST_CASE("scenes: the lit scene meets its double-precision reference", "[gpu]", test::Backends) {
    const auto folder = test::scenes();
    if (!folder) return;
    auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::must(load_gltf((*folder / "L1_lit.gltf").string()));
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment})
            for (const bool exact : {false, true}) {
                RenderSettings settings = known_settings(lit);
                settings.gbuffer = layout;
                settings.shading = stage;
                settings.exact = exact;
                const auto error = error_of(draw<TestType>(*device, scene, settings), *folder, lit);
                INFO(TestType::name << " " << name(layout) << " " << name(stage) << (exact ? " exact" : "") << ": RMSE "
                                    << error.rmse << ", p99.9 " << error.p999 << ", max " << error.max);
                CHECK(error.nonfinite == 0);
                CHECK(error.rmse <= 0.003);
                CHECK(error.p999 <= 0.02);
            }
}

TEMPLATE_LIST_TEST_CASE("scenes: object sorting cannot be exact where objects intersect, and says how far off it is",
                        "[gpu]", test::Backends) {
    const auto folder = test::scenes();
    if (!folder) return;
    auto device = test::make_device<TestType>();
    if (!device) return;
    for (const Known& known : unlit) {
        const Scene scene = test::must(load_gltf((*folder / (std::string(known.name) + ".gltf")).string()));
        RenderSettings settings = known_settings(known);
        settings.transparency = Transparency::sorted;
        const auto error = error_of(draw<TestType>(*device, scene, settings), *folder, known);
        std::printf("%s, sorted on %s: RMSE %.4f, max %.3f\n", known.name, TestType::name, error.rmse, error.max);
        CHECK(error.nonfinite == 0);
        CHECK(error.rmse > 0.01);  // intersecting objects: no order of whole objects is right
        CHECK(error.rmse < 0.12);
    }
}

#if defined(PELLUCID_HAS_OPENGL)
TEST_CASE("scenes: OpenGL draws the same bits from SPIR-V as from text", "[gpu]") {
    const auto folder = test::scenes();
    if (!folder) return;
    auto text = test::make_device<OpenGL>();
    auto spirv = test::make_device<OpenGL>([](rhi::DeviceDesc& desc) { desc.gl_spirv = true; });
    if (!text || !spirv) return;
    const Scene scene = test::must(load_gltf((*folder / "L1_lit.gltf").string()));
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            RenderSettings settings = known_settings(lit);
            settings.gbuffer = layout;
            settings.shading = stage;
            settings.exact = true;
            const Drawn a = draw<OpenGL>(*text, scene, settings), b = draw<OpenGL>(*spirv, scene, settings);
            INFO(name(layout) << " " << name(stage));
            CHECK(a.depth == b.depth);
            CHECK(a.hdr.data == b.hdr.data);
            CHECK(a.display.data == b.display.data);
        }
}
#endif

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
namespace {

void compare_backends(Vulkan::Device& vulkan, OpenGL::Device& opengl, const Scene& scene, RenderSettings settings) {
    settings.exact = true;
    const Drawn a = draw<Vulkan>(vulkan, scene, settings), b = draw<OpenGL>(opengl, scene, settings);
    CHECK(a.depth == b.depth);
    const auto exact = test::must(measure::image_error(a.hdr, b.hdr));
    CHECK(exact.different_pixels == 0);
    CHECK(exact.nonfinite == 0);
    const Drawn again = draw<Vulkan>(vulkan, scene, settings), gl_again = draw<OpenGL>(opengl, scene, settings);
    CHECK(a.hdr.data == again.hdr.data);
    CHECK(b.hdr.data == gl_again.hdr.data);

    settings.exact = false;
    const Drawn c = draw<Vulkan>(vulkan, scene, settings), d = draw<OpenGL>(opengl, scene, settings);
    CHECK(c.depth == d.depth);
    CHECK(c.depth == a.depth);
    CHECK(test::must(measure::image_error(c.display, d.display)).max <= 1);
    const auto close = test::must(measure::image_error(c.hdr, d.hdr, {.scale = measure::ErrorScale::scaled}));
    INFO("worst at " << close.worst.x << ", " << close.worst.y << ": " << close.worst.value << " against "
                     << close.worst.reference);
    CHECK(close.max <= 2e-3);
}

}  // namespace

TEST_CASE("scenes: Vulkan and OpenGL draw the same scenes and models", "[gpu]") {
    const auto folder = test::scenes();
    const auto assets = test::assets();
    if (!folder || !assets) return;
    auto vulkan = test::make_device<Vulkan>();
    auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl) return;
    for (const Known& known : {lit, unlit[0], unlit[1], unlit[2]}) {
        INFO(known.name);
        const Scene scene = test::must(load_gltf((*folder / (std::string(known.name) + ".gltf")).string()));
        compare_backends(*vulkan, *opengl, scene, known_settings(known));
    }
    for (const char* model : models) {
        INFO(model);
        const Scene scene = test::must(load_gltf((*assets / "models" / model).string()));
        compare_backends(*vulkan, *opengl, scene, {.size = {192, 192}});
    }
}
#endif
