// SPDX-License-Identifier: MIT
// Deferred lighting against the double reference, for the surface that the G-buffer really holds; every variant of the
// pass; and the same bits on both backends where they are promised.
#include <cstring>
#include "reference/sampling.hpp"
#include "support/light_cases.hpp"
#include "support/srgb_table.hpp"

using namespace pellucid;

namespace {
constexpr std::uint32_t n = 128;

struct LightingError {
    double below = 0, above = 0;  ///< largest (reference - value) and (value - reference), over max(1e-3, reference)
    double rmse = 0;              ///< of |value - reference| / max(1, reference)
    std::size_t covered = 0, nonfinite = 0;
};

/// The lit picture against the reference, from the compact texels that the pass read; `linear` is what the driver makes
/// of an sRGB code.
LightingError lighting_error(const ImageF& hdr, const std::vector<reference::CompactTexel>& texels, const Scene& scene,
                             const Camera& camera, const std::array<float, 256>& linear, Brdf brdf = Brdf::gltf) {
    const Extent2D size{hdr.width, hdr.height};
    const std::vector<Light> lights = reference::lights_in_view(scene.lights, camera);
    const reference::ClipCoefficients<double> clip(clip_from_view(camera, size));
    Camera eye = camera;
    eye.world_from_view = glm::dmat4(1);
    LightingError error;
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const reference::CompactTexel& t = texels[std::size_t{y} * size.width + x];
            if (t.depth == 0) continue;
            ++error.covered;
            auto surface = reference::unpack_surface<double>(t);
            for (int c = 0; c < 3; ++c) surface.base_color[c] = linear[t.color >> 8 * c & 0xFFu];
            const glm::dvec3 p =
                reference::view_from_depth(clip, reference::ndc_from_pixel<double>(x, y, size), double{t.depth});
            const glm::dvec3 wanted =
                reference::surface_radiance(surface, p, reference::direction_to_eye(eye, p), lights, glm::dvec3(0),
                                            static_cast<reference::BrdfModel>(brdf));
            for (int c = 0; c < 3; ++c) {
                const double got = hdr.texel(x, y)[c];
                error.nonfinite += !std::isfinite(got);
                const double scale = std::max(1e-3, wanted[c]);
                error.below = std::max(error.below, (wanted[c] - got) / scale);
                error.above = std::max(error.above, (got - wanted[c]) / scale);
                const double scaled = (got - wanted[c]) / std::max(1.0, wanted[c]);
                error.rmse += scaled * scaled;
            }
        }
    error.rmse = std::sqrt(error.rmse / (3.0 * static_cast<double>(error.covered)));
    return error;
}

// A half keeps 10 bits behind the leading one and drops the rest: the stored value is up to 2^-10 below the computed
// one and never above it.  Float arithmetic errs by 1e-5 of a value at the roughnesses of the scene.
constexpr double half_step = 0x1p-10;
constexpr double arithmetic = 1e-5;
}  // namespace

TEMPLATE_LIST_TEST_CASE("lighting agrees with the double reference in every stage and both builds", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::varied_scene();
    RenderSettings settings = test::settings_for(n);
    for (const bool exact : {false, true})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            settings.exact = exact;
            settings.shading = stage;
            const auto shot = test::shoot<TestType>(*device, scene, test::varied_camera(), settings);
            const LightingError e =
                lighting_error(shot.hdr, shot.compact(), scene, test::varied_camera(), test::srgb_table(*device));
            std::printf("%s %s%s: %.3g below, %.3g above, scaled RMSE %.3g\n", TestType::name, name(stage),
                        exact ? " exact" : "", e.below, e.above, e.rmse);
            INFO(name(stage) << (exact ? ", exact" : ""));
            CHECK(e.covered > n * n / 2);
            CHECK(e.nonfinite == 0);
            CHECK(e.below <= half_step + arithmetic);
            CHECK(e.above <= arithmetic);
            CHECK(e.rmse <= half_step / 2);
        }
}

TEMPLATE_LIST_TEST_CASE("the other reflectance models agree with the reference too", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::varied_scene();
    RenderSettings settings = test::settings_for(n);
    for (const Brdf brdf : {Brdf::seed, Brdf::blinn_phong}) {
        settings.brdf = brdf;
        const auto shot = test::shoot<TestType>(*device, scene, test::varied_camera(), settings);
        const LightingError e =
            lighting_error(shot.hdr, shot.compact(), scene, test::varied_camera(), test::srgb_table(*device), brdf);
        std::printf("%s %s: %.3g below, %.3g above, scaled RMSE %.3g\n", TestType::name, name(brdf), e.below, e.above,
                    e.rmse);
        INFO(name(brdf));
        CHECK(e.nonfinite == 0);
        // The seed's 1 - (N·H)² form loses digits at the roughness of 0.2.
        CHECK(e.below <= half_step + 3e-4);
        CHECK(e.above <= 3e-4);
    }
}

TEMPLATE_LIST_TEST_CASE("lighting of an orthographic view looks along its axis everywhere", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::varied_scene();
    Camera camera{.projection = Projection::orthographic,
                  .half_width = 2,
                  .half_height = 2,
                  .near = 0.5,
                  .far = 12,
                  .world_from_view = look_at({1, 3, 5}, {0, 0, 0})};
    const auto shot = test::shoot<TestType>(*device, scene, camera, test::settings_for(n));
    const LightingError e = lighting_error(shot.hdr, shot.compact(), scene, camera, test::srgb_table(*device));
    std::printf("%s orthographic: %.3g below, %.3g above\n", TestType::name, e.below, e.above);
    CHECK(e.covered > n * n / 4);
    CHECK(e.below <= half_step + arithmetic);
    CHECK(e.above <= arithmetic);
}

TEMPLATE_LIST_TEST_CASE("stages give the same picture; layouts give it within their own precision", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    const Scene scene = test::varied_scene();
    RenderSettings settings = test::settings_for(n);
    settings.exact = true;
    ImageF pictures[2][2];
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment}) {
            settings.gbuffer = layout;
            settings.shading = stage;
            pictures[static_cast<int>(layout)][static_cast<int>(stage)] =
                test::shoot<TestType>(*device, scene, test::varied_camera(), settings).hdr;
        }
    CHECK(pictures[0][0].data == pictures[0][1].data);
    CHECK(pictures[1][0].data == pictures[1][1].data);
    double sum = 0;
    for (std::size_t i = 0; i < pictures[0][0].data.size(); ++i) {
        const double a = pictures[0][0].data[i], b = pictures[1][0].data[i];
        sum += (a - b) * (a - b) / std::max(1.0, a * a);
    }
    const double rmse = std::sqrt(sum / static_cast<double>(pictures[0][0].data.size()));
    std::printf("%s: classic against compact, scaled RMSE %.3g\n", TestType::name, rmse);
    CHECK(rmse <= 5e-3);  // roughness in 8 bits moves the highlights
    CHECK(rmse > 0);
}

TEMPLATE_LIST_TEST_CASE("a scene far from the origin is lit as it is at the origin", "[gpu]", test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = test::varied_scene();
    Camera camera = test::varied_camera();
    const ImageF here = test::shoot<TestType>(*device, scene, camera, test::settings_for(n)).hdr;
    const glm::dvec3 away(1e5, -3e4, 7.7e4);
    for (Instance& i : scene.instances) i.world_from_object = test::at(away.x, away.y, away.z) * i.world_from_object;
    for (Light& light : scene.lights) light.position += away;
    camera.world_from_view[3] += glm::dvec4(away, 0);
    const auto there = test::shoot<TestType>(*device, scene, camera, test::settings_for(n));
    const LightingError e = lighting_error(there.hdr, there.compact(), scene, camera, test::srgb_table(*device));
    CHECK(e.below <= half_step + arithmetic);
    CHECK(e.above <= arithmetic);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < here.data.size(); ++i)
        moved += std::abs(here.data[i] - there.hdr.data[i]) > 2 * half_step * std::max(1e-3f, std::abs(here.data[i]));
    std::printf("%s: %zu of %zu values moved by an offset of 1.3e5 m\n", TestType::name, moved, here.data.size());
    CHECK(moved <= here.data.size() / 1000);  // silhouettes
}

TEMPLATE_LIST_TEST_CASE("lights of the uniform block and of the storage buffer give the same picture", "[gpu]",
                        test::Backends) {
    const auto device = test::make_device<TestType>();
    if (!device) return;
    Scene scene = test::varied_scene();
    test::Random random(5);
    while (scene.lights.size() < PELLUCID_LIGHT_BLOCK)
        scene.lights.push_back({.color = {1, 0.7f, 0.4f},
                                .intensity = 0.3f,
                                .position = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(1, 4)}});
    RenderSettings settings = test::settings_for(64);
    settings.lighting = LightAssignment::loop;
    settings.exact = true;
    CHECK(scene_needs(scene, settings).has(PELLUCID_NEED_LIGHT_BLOCK));
    const ImageF block = test::shoot<TestType>(*device, scene, test::varied_camera(), settings).hdr;
    // One more that gives nothing: the block has no room for it.
    scene.lights.push_back({.intensity = 0, .position = {0, 0, 5}});
    CHECK_FALSE(scene_needs(scene, settings).has(PELLUCID_NEED_LIGHT_BLOCK));
    const ImageF stored = test::shoot<TestType>(*device, scene, test::varied_camera(), settings).hdr;
    CHECK(test::different_pixels(block, stored) == 0);
    scene.lights.clear();
    CHECK_FALSE(scene_needs(scene, {.size = settings.size, .default_light = false}).has(PELLUCID_NEED_LIGHT_BLOCK));
}

#if defined(PELLUCID_HAS_VULKAN) && defined(PELLUCID_HAS_OPENGL)
TEST_CASE("the exact build gives the same bits on both backends", "[gpu]") {
    const auto vulkan = test::make_device<Vulkan>();
    const auto opengl = test::make_device<OpenGL>();
    if (!vulkan || !opengl || vulkan->info().software != opengl->info().software) return;
    const Scene scene = test::varied_scene();
    RenderSettings settings = test::settings_for(n);
    settings.exact = true;
    for (const GBufferLayout layout : {GBufferLayout::compact, GBufferLayout::classic})
        for (const ShadingStage stage : {ShadingStage::compute, ShadingStage::fragment})
            for (const Brdf brdf : {Brdf::gltf, Brdf::seed, Brdf::blinn_phong}) {
                settings.gbuffer = layout;
                settings.shading = stage;
                settings.brdf = brdf;
                const auto a = test::shoot<Vulkan>(*vulkan, scene, test::varied_camera(), settings);
                const auto b = test::shoot<OpenGL>(*opengl, scene, test::varied_camera(), settings);
                std::size_t different = 0;
                for (std::size_t i = 0; i < a.hdr.data.size(); ++i)
                    different += std::memcmp(&a.hdr.data[i], &b.hdr.data[i], 4) != 0;
                INFO(name(layout) << ", " << name(stage) << ", " << name(brdf));
                CHECK(different == 0);
                if (layout == GBufferLayout::compact && brdf == Brdf::gltf) CHECK(a.compact() == b.compact());
            }
}
#endif
